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

    const ImageFormat& format() const { return sources_.front().format(); }
    ImageShape shape() const;

    // Calls `row` for rows 0, 1, ... with that row of every image. Once. Throws
    // Failure(Exit::interrupted), and Failure(Exit::file) where a file ends early.
    using Row = std::function<void(int y, std::span<const std::span<const double>> rows)>;
    void for_each_row(const Row& row);

  private:
    std::vector<ImageSource> sources_;
};

// What values of such a file are rounded to.
Quantisation quantisation_of(const ImageFormat& format);

// Throws Failure(Exit::file) where images `a` and `b` are not of one size, channels and depth.
void require_same_format(const ImageSource& a, const ImageSource& b);

}  // namespace mpipov
