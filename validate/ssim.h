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

struct SsimPair {
    std::filesystem::path a, b;
    std::filesystem::path map;  // file to get the map, 1 channel, same size; empty: none
};

// Of all pairs in one go: Python with its libraries takes longer to start than to work on small
// images. The images of a pair have the same size, channels and depth. `peak` is the dynamic range
// L, where full scale is 1. Throws Failure.
std::vector<Ssim> compute_ssim(const std::vector<SsimPair>& pairs, double peak);

// Of identical images, without computing it.
Ssim ssim_of_identical();

}  // namespace mpipov
