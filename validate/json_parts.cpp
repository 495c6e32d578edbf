#include "json_parts.h"

#include "rect_corners.h"

#include <cmath>

namespace mpipov {

using nlohmann::json;

json number_json(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? json(*value) : json();
}

json text_json(const std::string& value) {
    return value.empty() ? json() : json(value);
}

json rect_json(const Rect& rect) {
    return rect.empty() ? json() : corners_json(rect);
}

json line_json(const Seam& line) {
    return {{"a", line.a},
            {"b", line.b},
            {"vertical", line.vertical},
            {"position", line.position},
            {"from", line.from},
            {"to", line.to}};
}

json image_json(const ImageFormat& format) {
    return {{"width", format.width},
            {"height", format.height},
            {"channels", format.channels},
            {"depth", format.depth}};
}

json typed_image_json(const ImageFormat& format) {
    json j = image_json(format);
    j["type"] = format.type;
    return j;
}

json file_json(const std::filesystem::path& file, const std::filesystem::path& folder) {
    if (file.empty()) return nullptr;
    const std::filesystem::path inside = file.lexically_relative(folder);
    return inside.empty() || *inside.begin() == ".." ? file.string() : inside.string();
}

}  // namespace mpipov
