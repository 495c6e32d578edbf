// The truth that settings are measured against: a render without antialiasing at k times the size,
// averaged k x k (supersample.h says in which light, and how its own error is known).
//
// Where the picture depends on the order of rendering it is the mean of two such renders in two
// orders of blocks, and half their difference counts as error too. With radiosity each has a cache
// of its own, made of k times as many pixels: the truth is what the scene's own radiosity settings
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
    int factor = 8;             // k, even
    Averaging averaging = Averaging::linear;
    bool order_dependent = false;
    int threads = 1;  // where it does not depend on the order
};

// All errors are RMS in encoded values, 0..1.
struct Truth {
    int factor = 0;
    int renders = 0;
    std::vector<std::vector<std::string>> argv;  // of each render
    double wall_seconds = 0, cpu_seconds = 0;    // of all renders
    double sampling_error = 0, rounding_error = 0, order_error = 0;
    // PNGs of 16 bits, of the whole size, black outside of the region: the truth, and what it were
    // if its samples had been averaged the other way.
    std::filesystem::path image, other;

    double error() const;  // all of it together
};

// The images are put into `folder`. Throws as SerialRenderer::render.
Truth render_truth(const SerialRenderer& renderer, const TruthRequest& request,
                   const std::filesystem::path& scratch, const std::filesystem::path& folder);

// The k that brings an error of `error` with `factor` down to `wanted`: an error goes with 1/k
// where samples are random, and faster where they are not. Even, from factor + 2, at most `most`.
int next_factor(int factor, double error, double wanted, int most);

}  // namespace mpipov
