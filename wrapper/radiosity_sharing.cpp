#include "radiosity_sharing.h"

#include <fmt/format.h>

#include <algorithm>

namespace mpipov {
namespace {

// The wave of each section: the first that no neighbour is in. In reading order that makes a
// chessboard of a grid.
std::vector<int> colours(const std::vector<Section>& sections) {
    std::vector<std::vector<int>> neighbours(sections.size());
    for (const Seam& seam : find_seams(sections)) {
        neighbours[static_cast<std::size_t>(seam.a)].push_back(seam.b);
        neighbours[static_cast<std::size_t>(seam.b)].push_back(seam.a);
    }
    std::vector<int> colours(sections.size(), -1);
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const auto is_taken = [&](int colour) {
            return std::ranges::any_of(neighbours[i], [&](int other) {
                return colours[static_cast<std::size_t>(other)] == colour;
            });
        };
        int colour = 0;
        while (is_taken(colour)) ++colour;
        colours[i] = colour;
    }
    return colours;
}

// Where the pixel edge `at` of a side of `full` pixels lies on one of `small` pixels.
int scaled(int at, int full, int small) {
    return static_cast<int>(static_cast<long long>(at) * small / full);
}

// At least one pixel, which neighbours may share: they gather, they do not make an image.
Rect scaled(const Rect& rect, const ImageSize& full, const ImageSize& small) {
    Rect out{scaled(rect.x0, full.width, small.width), scaled(rect.y0, full.height, small.height),
             scaled(rect.x1, full.width, small.width), scaled(rect.y1, full.height, small.height)};
    out.x1 = std::max(out.x1, out.x0 + 1);
    out.y1 = std::max(out.y1, out.y0 + 1);
    return out;
}

// POV-Ray refuses an image of one pixel's width where the region ends at 1 (povray_command.h).
ImageSize scaled(const ImageSize& image, long long scale) {
    return {static_cast<int>(std::max(2LL, image.width / scale)),
            static_cast<int>(std::max(2LL, image.height / scale))};
}

Section gathering(int id, const Rect& rect) {
    return {id, rect, rect};
}

// By the number of its wave for each section.
std::vector<GatherWave> waves_of(const std::vector<Section>& sections,
                                 const std::vector<int>& wave_of, const ImageSize& image,
                                 const ImageSize& size) {
    std::vector<GatherWave> waves(static_cast<std::size_t>(*std::ranges::max_element(wave_of)) + 1,
                                  {size, {}});
    for (std::size_t i = 0; i < sections.size(); ++i) {
        std::vector<Section>& wave = waves[static_cast<std::size_t>(wave_of[i])].sections;
        wave.push_back(
            gathering(static_cast<int>(wave.size()), scaled(sections[i].keep, image, size)));
    }
    return waves;
}

}  // namespace

std::string_view to_string(Sharing sharing) {
    switch (sharing) {
        case Sharing::independent:
            return "independent";
        case Sharing::shared:
            return "shared";
        case Sharing::joined:
            return "joined";
    }
    return "?";
}

std::string describe(const RadiositySharing& sharing) {
    if (sharing.how == Sharing::independent) return "independent";
    const std::string scale = sharing.scale > 1 ? fmt::format(" at 1/{}", sharing.scale) : "";
    return fmt::format("{}:{}{}", to_string(sharing.how), sharing.passes, scale);
}

std::vector<GatherWave> gather_waves(const RadiositySharing& sharing, const ImageSize& image,
                                     const Partition& partition) {
    if (sharing.how == Sharing::independent) return {};
    std::vector<GatherWave> waves;
    if (sharing.how == Sharing::shared) {
        const ImageSize size = scaled(image, sharing.scale);
        const Section all = gathering(0, scaled(partition.request.region, image, size));
        waves.assign(static_cast<std::size_t>(sharing.passes), {size, {all}});
        return waves;
    }
    const std::vector<int> last = colours(partition.sections);
    const std::vector<int> together(partition.sections.size(), 0);
    for (int pass = 1; pass <= sharing.passes; ++pass) {
        // No further than to a few pixels, whatever is asked for.
        const int halvings = std::min(sharing.passes - pass, 20);
        const ImageSize size = scaled(image, static_cast<long long>(sharing.scale) << halvings);
        const auto pass_waves =
            waves_of(partition.sections, pass < sharing.passes ? together : last, image, size);
        waves.insert(waves.end(), pass_waves.begin(), pass_waves.end());
    }
    return waves;
}

}  // namespace mpipov
