// The truth that settings are measured against: two renders at 8 and 10 times the size, averaged to
// the pixels (supersample.h says in which light, and how its own error is known).
//
// Where 164 samples a pixel are too few, each pixel of those renders is itself the mean of n x n
// samples, and of one in its middle: POV-Ray's antialiasing of method 1 with a threshold of 0,
// which leaves out no pixel, and without jitter (docs/povray.md has the experiments). So renders do
// not grow in memory.
//
// Where the picture depends on the order of rendering the two renders take their blocks in two
// orders, so that what the order does counts as error too. With radiosity each has a cache of its
// own, made from many times as many pixels: the truth is what the scene's own radiosity settings
// come to with more places to take samples at, not what other settings would give.
#pragma once

#include "section.h"
#include "serial_render.h"
#include "supersample.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mpipov {

struct TruthRequest {
    int width = 0, height = 0;  // of the whole image
    Rect region;                // what of it is rendered
    int depth = 1;              // n; 1: a pixel of the large renders is one sample
    Averaging averaging = Averaging::linear;
    bool order_dependent = false;
    int threads = 1;  // where it does not depend on the order
};

inline constexpr int deepest_truth = 9;  // of POV-Ray's method 1

// All errors are RMS in encoded values, 0..1.
struct Truth {
    int depth = 0;
    std::vector<std::vector<std::string>> argv;  // of each render
    double wall_seconds = 0, cpu_seconds = 0;    // of all renders
    double sampling_error = 0, rounding_error = 0;
    // PNGs of 16 bits, of the whole size, black outside of the region: the truth, and what it were
    // if its samples had been averaged the other way.
    std::filesystem::path image, other;

    int samples() const;   // a pixel
    double error() const;  // all of it together
};

// 164 with a depth of 1.
int truth_samples(int depth);

// The images are put into `folder`. Throws as SerialRenderer::render.
Truth render_truth(const SerialRenderer& renderer, const TruthRequest& request,
                   const std::filesystem::path& scratch, const std::filesystem::path& folder);

// The depth, above `depth`, that brings an error of `error` down to `wanted`: an error goes with
// the root of the samples where they are random, and faster where they are not. `most` where none
// does; `depth` where that is no more.
int next_depth(int depth, double error, double wanted, int most);

// The deepest truth of at most so many samples, that is not expected to take more seconds than that
// if `known` tells; 0: none.
int deepest_within(int samples, double seconds, const Truth& known);

}  // namespace mpipov
