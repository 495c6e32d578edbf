#include "noise_variants.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace mpipov {

NoiseVariant noise_variant(int index, bool keep_blocks) {
    static constexpr std::array patterns{2, 5, 4, 1, 3};
    static constexpr std::array sizes{16, 24, 8, 12, 20};
    const auto i = static_cast<std::size_t>(index);
    if (i < patterns.size())
        return {fmt::format("RP{}", patterns[i]), {fmt::format("+RP{}", patterns[i])}};
    // Odd steps from 3 on, with patterns that go round: an even step is ignored whenever the number
    // of blocks is even.
    const int step = 3 + 2 * (index - static_cast<int>(patterns.size()));
    const int pattern = index % 6;
    NoiseVariant variant{
        fmt::format("RP{}-step{}", pattern, step),
        {fmt::format("+RP{}", pattern), fmt::format("Render_Block_Step={}", step)}};
    if (!keep_blocks) {
        const int size = sizes[i % sizes.size()];
        variant.name += fmt::format("-BS{}", size);
        variant.arguments.push_back(fmt::format("+BS{}", size));
    }
    return variant;
}

}  // namespace mpipov
