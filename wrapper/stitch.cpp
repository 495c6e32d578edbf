#include "stitch.h"

#include "sha1_digits.h"

#include <Imath/half.h>
#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>

namespace mpipov {
namespace {

static_assert(std::endian::native == std::endian::little,
              "run.json promises the SHA-1 of little-endian pixels");

std::size_t row_offset(const Rect& rect, int y, std::size_t pixel) {
    return static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(rect.width()) * pixel;
}

void require_fits(const Canvas& canvas, const Rect& rect, std::optional<std::size_t> bytes) {
    const Rect bounds = canvas.bounds();
    if (rect.empty() || intersect(rect, bounds) != rect)
        throw std::invalid_argument(
            fmt::format("the rectangle ({}, {}) to ({}, {}) does not lie within {}x{} pixels",
                        rect.x0, rect.y0, rect.x1, rect.y1, bounds.width(), bounds.height()));
    const std::size_t needed =
        static_cast<std::size_t>(rect.area()) * canvas.layout().bytes_per_pixel();
    if (bytes && *bytes != needed)
        throw std::invalid_argument(fmt::format("{} bytes of pixels where {}x{} take {}", *bytes,
                                                rect.width(), rect.height(), needed));
}

template <typename Value>
Value load(const std::byte* at) {
    Value value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

double value_at(const std::byte* at, Depth depth) {
    switch (depth) {
        case Depth::uint8:
            return load<std::uint8_t>(at);
        case Depth::uint16:
            return load<std::uint16_t>(at);
        case Depth::half:
            return imath_half_to_float(load<std::uint16_t>(at));
        case Depth::float32:
            return load<float>(at);
    }
    return 0;
}

template <typename Value>
std::vector<std::byte> bytes_of(Value value) {
    std::vector<std::byte> bytes(sizeof value);
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

// Full alpha.
std::vector<std::byte> opaque(Depth depth) {
    switch (depth) {
        case Depth::uint8:
            return bytes_of(std::numeric_limits<std::uint8_t>::max());
        case Depth::uint16:
            return bytes_of(std::numeric_limits<std::uint16_t>::max());
        case Depth::half:
            return bytes_of(imath_float_to_half(1));
        case Depth::float32:
            return bytes_of(1.0F);
    }
    return {};
}

}  // namespace

Canvas::Canvas(const PixelLayout& layout) : layout_(layout) {
    if (layout.width < 1 || layout.height < 1 || layout.channels < 1)
        throw std::invalid_argument(fmt::format("an image of {}x{} pixels with {} channels",
                                                layout.width, layout.height, layout.channels));
    const std::size_t size = layout.row_bytes() * static_cast<std::size_t>(layout.height);
    void* pixels = ::mmap(nullptr, size, PROT_READ | PROT_WRITE,
                          MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (pixels == MAP_FAILED)
        throw std::runtime_error(fmt::format("no memory for {}x{} pixels ({} bytes): {}",
                                             layout.width, layout.height, size,
                                             std::strerror(errno)));
    pixels_ = {static_cast<std::byte*>(pixels), Unmap{size}};
}

void Canvas::Unmap::operator()(std::byte* pixels) const {
    ::munmap(pixels, size);
}

void Canvas::place(const Rect& rect, std::span<const std::byte> pixels, const Rect& keep) {
    require_fits(*this, rect, pixels.size());
    const std::size_t pixel = layout_.bytes_per_pixel();
    const Rect part = intersect(rect, keep);
    if (part.empty()) return;
    const std::size_t bytes = static_cast<std::size_t>(part.width()) * pixel;
    for (int y = part.y0; y < part.y1; ++y)
        std::memcpy(pixels_.get() + row_offset(bounds(), y, pixel) +
                        static_cast<std::size_t>(part.x0) * pixel,
                    pixels.data() + row_offset(rect, y, pixel) +
                        static_cast<std::size_t>(part.x0 - rect.x0) * pixel,
                    bytes);
}

void Canvas::make_opaque(const Rect& rect) {
    const std::size_t pixel = layout_.bytes_per_pixel();
    const std::vector<std::byte> one = opaque(layout_.depth);
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x)
            std::ranges::copy(one, pixels_.get() + row_offset(bounds(), y, pixel) +
                                       static_cast<std::size_t>(x + 1) * pixel - one.size());
}

void Canvas::make_opaque_outside(const Rect& region) {
    if (layout_.channels != 2 && layout_.channels != 4) return;
    const Rect all = bounds();
    make_opaque({0, 0, all.x1, region.y0});
    make_opaque({0, region.y1, all.x1, all.y1});
    make_opaque({0, region.y0, region.x0, region.y1});
    make_opaque({region.x1, region.y0, all.x1, region.y1});
}

std::vector<std::byte> Canvas::read(const Rect& rect) const {
    require_fits(*this, rect, std::nullopt);
    const std::size_t pixel = layout_.bytes_per_pixel();
    const std::size_t bytes = static_cast<std::size_t>(rect.width()) * pixel;
    std::vector<std::byte> pixels(static_cast<std::size_t>(rect.height()) * bytes);
    for (int y = rect.y0; y < rect.y1; ++y)
        std::ranges::copy(rows(y, y + 1).subspan(static_cast<std::size_t>(rect.x0) * pixel, bytes),
                          pixels.begin() + static_cast<std::ptrdiff_t>(row_offset(rect, y, pixel)));
    return pixels;
}

std::span<const std::byte> Canvas::rows(int y0, int y1) const {
    require_fits(*this, {0, y0, layout_.width, y1}, std::nullopt);
    return {pixels_.get() + static_cast<std::size_t>(y0) * layout_.row_bytes(),
            static_cast<std::size_t>(y1 - y0) * layout_.row_bytes()};
}

std::string Canvas::sha1() const {
    const auto all = rows(0, layout_.height);
    OIIO::SHA1 hash(all.data(), all.size());
    return sha1_digits(hash);
}

Difference differing_pixels(const Canvas& canvas, const Rect& rect,
                            std::span<const std::byte> pixels, const Rect& within) {
    require_fits(canvas, rect, pixels.size());
    const Depth depth = canvas.layout().depth;
    const std::size_t pixel = canvas.layout().bytes_per_pixel();
    const Rect part = intersect(rect, within);
    Difference difference;
    for (int y = part.y0; y < part.y1; ++y) {
        const std::byte* ours = canvas.rows(y, y + 1).data();
        const std::byte* theirs = pixels.data() + row_offset(rect, y, pixel);
        for (int x = part.x0; x < part.x1; ++x) {
            const std::byte* a = ours + static_cast<std::size_t>(x) * pixel;
            const std::byte* b = theirs + static_cast<std::size_t>(x - rect.x0) * pixel;
            if (std::memcmp(a, b, pixel) == 0) continue;
            ++difference.pixels;
            for (std::size_t at = 0; at < pixel; at += bytes_per_value(depth)) {
                if (std::memcmp(a + at, b + at, bytes_per_value(depth)) == 0) continue;
                const double step = std::abs(value_at(a + at, depth) - value_at(b + at, depth));
                difference.largest = std::isfinite(step) ? std::max(difference.largest, step)
                                                         : std::numeric_limits<double>::infinity();
            }
        }
    }
    return difference;
}

}  // namespace mpipov
