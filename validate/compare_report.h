// A comparison as JSON and as text for people. Both say the same.
//
// Errors are b - a in stored units: levels of integer images (full_scale 255 or 65535), the values
// of float images (full_scale 1). At the top level of the JSON they are given twice, as
// {"levels": number|null, "full_scale": number}; in its lists (channels, run) in stored units.
// null stands for what is undefined: means over nothing, and what JSON has no number for: the PSNR
// of images without an error. "psnr_reason" says which of the two it is, or is null.
#pragma once

#include "compare.h"

#include <nlohmann/json.hpp>

#include <string>

namespace mpipov {

nlohmann::json to_json(const Comparison& comparison);
nlohmann::json to_json(const SeamReport& report);

std::string to_table(const Comparison& comparison);
// `unit`: what errors are counted in, for headings.
std::string to_table(const SeamReport& report, const std::string& unit);

}  // namespace mpipov
