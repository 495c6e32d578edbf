// A rectangle as our JSON files have it.
#pragma once

#include "json_input.h"
#include "section.h"

namespace mpipov {

inline nlohmann::json corners_json(const Rect& r) {
    return {{"x0", r.x0}, {"y0", r.y0}, {"x1", r.x1}, {"y1", r.y1}};
}

// None of it negative, so that no width or height overflows.
inline Rect rect_from_corners(const nlohmann::json& j) {
    return {member<int>(j, "x0", 0), member<int>(j, "y0", 0), member<int>(j, "x1", 0),
            member<int>(j, "y1", 0)};
}

}  // namespace mpipov
