// Which serial renders of a scene are as right as the default one. Pure.
//
// POV-Ray's random numbers are one stream per thread, so what a pixel gets of it depends on what
// was rendered before. With one thread, another order of the render blocks (+RP0..5,
// Render_Block_Step) is another throw of the dice and nothing else: each of these renders is what
// POV-Ray could as well have done by default, and each can be repeated bit for bit, unlike renders
// by several threads.
// The block size must stay where antialiasing is of method 1: it compares pixels within a block
// only, so that +BS changes pixels at the blocks' edges for a reason that is no noise. Without it
// +BS gives more orders to choose from.
// A step that shares a factor with the number of blocks is ignored by POV-Ray, and a small image
// has few blocks: some variants come out alike, and only one of these counts.
#pragma once

#include <string>
#include <vector>

namespace mpipov {

struct NoiseVariant {
    std::string name;  // of a file, too
    std::vector<std::string> arguments;
};

// index from 0; all different, though not all of their images need be.
NoiseVariant noise_variant(int index, bool keep_blocks);

// After so many variants whose image is the serial one, a scene counts as exact; the first ones are
// those that have been seen to find a dependence that others miss.
inline constexpr int variants_to_call_exact = 4;

}  // namespace mpipov
