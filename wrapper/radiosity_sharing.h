// How sections share radiosity samples, and what is rendered for that before the image. Pure.
//
// A radiosity sample that POV-Ray takes is used for the pixels that come later, so sections that
// know nothing of each other differ where they meet. A cache that all of them read takes the step
// away; how it is made decides what that costs (docs/radiosity.md).
#pragma once

#include "povray_command.h"
#include "section.h"

#include <string>
#include <string_view>
#include <vector>

namespace mpipov {

enum class Sharing {
    independent,  // each section takes its own samples
    shared,       // one launch renders the whole region first, and its cache is read by all
    joined,       // sections gather samples side by side, in waves; what they took is joined
};
std::string_view to_string(Sharing sharing);

struct RadiositySharing {
    Sharing how = Sharing::independent;
    // Over the whole region; each reads what the earlier ones took. Those of `joined` go from
    // coarse to fine, as POV-Ray's own pretrace does: each has twice the width and height of the
    // last.
    int passes = 1;
    int scale = 1;  // the last pass is rendered at 1/scale of the image's width and height
    bool operator==(const RadiositySharing&) const = default;
};

// "independent", "shared:2", "joined:1 at 1/2"
std::string describe(const RadiositySharing& sharing);

// Sections that gather samples side by side and read what was joined before. The last pass of
// `joined` has several: no two neighbours are in one wave, so of two that meet the later one reads
// what the earlier one took at their seam, as it is within one launch.
struct GatherWave {
    ImageSize image;                // of the render, pixels
    std::vector<Section> sections;  // ids count from 0; render is keep, in pixels of `image`
};

// In the order in which they run; none with Sharing::independent. `image` is the size of the final
// one, `partition` how it is cut up.
std::vector<GatherWave> gather_waves(const RadiositySharing& sharing, const ImageSize& image,
                                     const Partition& partition);

}  // namespace mpipov
