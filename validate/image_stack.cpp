#include "image_stack.h"

#include "failure.h"
#include "interrupt.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mpipov {

namespace {

void require_same_format(const ImageSource& a, const ImageSource& b) {
    const ImageFormat& p = a.format();
    const ImageFormat& q = b.format();
    const auto fail = [&](const std::string& what, const std::string& of_a,
                          const std::string& of_b) {
        throw Failure(Exit::file,
                      fmt::format("cannot compare '{}' with '{}': {} differ, {} and {}",
                                  a.file().string(), b.file().string(), what, of_a, of_b));
    };
    if (p.width != q.width || p.height != q.height)
        fail("their sizes", fmt::format("{} x {}", p.width, p.height),
             fmt::format("{} x {}", q.width, q.height));
    if (p.channels != q.channels)
        fail("their channels", fmt::format("{}", fmt::join(p.channels, ",")),
             fmt::format("{}", fmt::join(q.channels, ",")));
    if (p.depth != q.depth) fail("their depths", p.depth, q.depth);
}

}  // namespace

ImageStack::ImageStack(const std::vector<std::filesystem::path>& files) {
    sources_.reserve(files.size());
    for (const auto& file : files) {
        sources_.emplace_back(file);
        require_same_format(sources_.front(), sources_.back());
    }
}

ImageShape ImageStack::shape() const {
    return {format().width, format().height, format().channel_count(), format().alpha};
}

void ImageStack::for_each_row(const Row& row, int rows_per_band) {
    std::vector<ImageBand> bands(sources_.size());
    std::vector<std::span<const double>> rows(sources_.size());
    while (sources_.front().next_band(rows_per_band, bands.front())) {
        throw_if_interrupted();
        for (std::size_t i = 1; i < sources_.size(); ++i)
            sources_[i].next_band(rows_per_band, bands[i]);
        for (int r = 0; r < bands.front().rows; ++r) {
            for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = bands[i].row(r);
            row(bands.front().y + r, rows);
        }
    }
}

Quantisation quantisation_of(const ImageFormat& format) {
    if (format.integer()) return {Quantisation::Kind::levels};
    if (format.type == "hdr") return {Quantisation::Kind::shared_exponent};
    return {format.depth == "half" ? Quantisation::Kind::half : Quantisation::Kind::float32};
}

}  // namespace mpipov
