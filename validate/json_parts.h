// What several of our JSON files say in the same words. Units are pixels, 0-based, half-open.
#pragma once

#include "image_source.h"
#include "section.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace mpipov {

// null where there is none, or none that JSON can hold.
nlohmann::json number_json(const std::optional<double>& value);
// null for an empty text.
nlohmann::json text_json(const std::string& value);
// null for an empty one.
nlohmann::json rect_json(const Rect& rect);
// A seam, or a line along which one could be.
nlohmann::json line_json(const Seam& line);
// Without the file type, which two images that are compared need not share.
nlohmann::json image_json(const ImageFormat& format);
nlohmann::json typed_image_json(const ImageFormat& format);
// A file's path, relative to `folder` where it lies in it; null for none.
nlohmann::json file_json(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace mpipov
