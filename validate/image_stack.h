// Several images of the same size, channels and depth, read row by row at the same time. In memory
// are a few rows of each.
#pragma once

#include "image_source.h"
#include "metrics.h"
#include "noise_floor.h"

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace mpipov {

class ImageStack {
  public:
    // Throws Failure(Exit::file) where one cannot be read or is not like the first.
    explicit ImageStack(const std::vector<std::filesystem::path>& files);

    const ImageFormat& format(std::size_t image = 0) const { return sources_[image].format(); }
    ImageShape shape() const;

    // Calls `row` for rows 0, 1, ... with that row of every image. Once. `rows_per_band` changes
    // memory, not results. Throws Failure(Exit::interrupted), and Failure(Exit::file) where a file
    // ends early.
    using Row = std::function<void(int y, std::span<const std::span<const double>> rows)>;
    void for_each_row(const Row& row, int rows_per_band = 8);

  private:
    std::vector<ImageSource> sources_;
};

// What values of such a file are rounded to.
Quantisation quantisation_of(const ImageFormat& format);

}  // namespace mpipov
