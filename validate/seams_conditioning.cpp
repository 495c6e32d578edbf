#include "seams_conditioning.h"

#include "failure.h"
#include "stability_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace mpipov {

void SeamsConditioning::measure(SeamsReport& report) {
    fmt::print(stderr, "is the scene to be blamed? moving its camera\n");
    report.conditioning.emplace();
    const SerialSet& serial = *report.serial;
    StabilityRequest request;
    request.arguments = arguments_;
    request.povray = povray_;
    request.rules = rules_;
    request.folder = folder_;
    request.reference = serial.reference();
    request.full_map = true;
    for (const NoiseRender& render : serial.noise.renders)
        request.noise = std::max(request.noise.value_or(0),
                                 render.comparison.metrics.all.mean_abs().value_or(0));
    try {
        map_ = measure_stability(request, serial.scene, report.conditioning->found);
    } catch (const Failure& failure) {
        if (failure.code() == Exit::interrupted) throw;
        report.conditioning->failure = failure.what();
    }
}

void SeamsConditioning::reconsider(SeamsCase& one, const std::filesystem::path& reference,
                                   SeamsReport& report) {
    if (!report.conditioning) measure(report);
    const auto& scene = report.conditioning->found.verdict;
    if (!map_ || !scene || scene->kind != Conditioning::ill) return;
    one.verdict = reconsidered(one.verdict, scene->why, map_->explain(reference, one.image));
}

}  // namespace mpipov
