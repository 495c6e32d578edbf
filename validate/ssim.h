// Structural similarity of two image files, by scikit-image (ssim.py, which names the settings).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct Ssim {
    std::optional<double> value;      // mean over the colour channels, at most 1
    std::vector<double> per_channel;  // in the file's order, alpha included
    std::string reason;               // why there is no value, or why it was not computed
};

// Both images have the same size, channels and depth. `peak` is the dynamic range L, where full
// scale is 1. `map`: file to get the map, 1 channel, same size; empty: none. Throws Failure.
Ssim compute_ssim(const std::filesystem::path& a, const std::filesystem::path& b, double peak,
                  const std::filesystem::path& map);

}  // namespace mpipov
