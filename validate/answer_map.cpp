#include "answer_map.h"

#include "image_source.h"
#include "image_stack.h"
#include "stability_verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace mpipov {

namespace fs = std::filesystem;

namespace {

// The largest difference of a channel; infinite where one is not finite in one of them alone.
double difference(std::span<const double> a, std::span<const double> b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (same_value(a[i], b[i])) continue;
        const double off = std::abs(b[i] - a[i]);
        largest =
            std::max(largest, std::isfinite(off) ? off : std::numeric_limits<double>::infinity());
    }
    return largest;
}

// Calls `pixel(x, y, difference, level)` for every pixel of two images.
template <class Pixel>
void for_each_pixel(const fs::path& a, const fs::path& b, const Pixel& pixel) {
    ImageStack stack({a, b});
    const double level = stack.format().full_scale() / 255;
    const auto channels = static_cast<std::size_t>(stack.shape().channels);
    stack.for_each_row([&](int y, std::span<const std::span<const double>> rows) {
        for (int x = 0; x < stack.shape().width; ++x) {
            const std::size_t first = static_cast<std::size_t>(x) * channels;
            pixel(x, y,
                  difference(rows[0].subspan(first, channels), rows[1].subspan(first, channels)),
                  level);
        }
    });
}

}  // namespace

AnswerMap::AnswerMap(fs::path reference) : reference_(std::move(reference)) {
    const ImageFormat format = ImageSource(reference_).format();
    width_ = format.width;
    height_ = format.height;
    first_.resize(at(0, height_));
    largest_.resize(at(0, height_));
}

long long AnswerMap::add(const fs::path& moved, double move) {
    long long answering = 0;
    ++moves_;
    for_each_pixel(reference_, moved, [&](int x, int y, double off, double level) {
        if (move <= next_to_nothing) {
            float& largest = largest_[at(x, y)];
            largest = std::max(largest, static_cast<float>(off));
        }
        if (!(off > level)) return;
        ++answering;
        if (first_[at(x, y)] == 0) first_[at(x, y)] = moves_;
    });
    return answering;
}

void AnswerMap::write(const fs::path& file) const {
    std::vector<float> gray(first_.size());
    std::transform(first_.begin(), first_.end(), gray.begin(), [&](std::uint8_t first) {
        return first == 0 ? 0.0F
                          : static_cast<float>(moves_ + 1 - first) / static_cast<float>(moves_);
    });
    write_gray_image(file, width_, height_, gray);
}

float AnswerMap::explained(int x, int y) const {
    float largest = 0;
    for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u)
            largest = std::max(largest, largest_[at(u, v)]);
    return largest;
}

AnswerMap::Differing AnswerMap::explain(const fs::path& own_reference,
                                        const fs::path& image) const {
    Differing found;
    for_each_pixel(own_reference, image, [&](int x, int y, double off, double /*level*/) {
        if (off == 0) return;
        ++found.all;
        if (static_cast<float>(off) > explained(x, y)) ++found.unexplained;
    });
    return found;
}

}  // namespace mpipov
