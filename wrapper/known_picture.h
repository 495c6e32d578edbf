// A picture that every test of the protocol knows without a renderer: 3 channels of 8 bits, each a
// function of the place in the image.
#pragma once

#include "section.h"

#include <array>
#include <cstddef>
#include <vector>

namespace mpipov {

constexpr int known_channels = 3;

// Never 0, as what was not rendered is, and at most 200.
constexpr std::array<unsigned char, known_channels> known_pixel(int x, int y) {
    return {static_cast<unsigned char>(1 + (x * 7 + y * 13) % 200),
            static_cast<unsigned char>(1 + (x * y + 3 * x) % 199),
            static_cast<unsigned char>(1 + (x + 5 * y) % 197)};
}

inline std::vector<std::byte> known_pixels(const Rect& rect) {
    std::vector<std::byte> pixels;
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x)
            for (const unsigned char value : known_pixel(x, y))
                pixels.push_back(static_cast<std::byte>(value));
    return pixels;
}

}  // namespace mpipov
