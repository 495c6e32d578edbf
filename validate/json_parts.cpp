#include "json_parts.h"

#include <cmath>

namespace mpipov {

using nlohmann::json;

json number_json(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? json(*value) : json();
}

json rect_json(const Rect& rect) {
    if (rect.empty()) return nullptr;
    return {{"x0", rect.x0}, {"y0", rect.y0}, {"x1", rect.x1}, {"y1", rect.y1}};
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

}  // namespace mpipov
