#include "seams_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace mpipov {
namespace {

std::string number(const std::optional<double>& value) {
    return value ? fmt::format("{:.4g}", *value) : "-";
}

void case_row(std::back_insert_iterator<std::string> out, const SeamsCase& one, std::size_t width) {
    std::string differing = "-", largest = "-", ssim = "-", seams = "-", controls = "-",
                found = "-", quiet = "-";
    if (one.comparison) {
        const Metrics& metrics = one.comparison->metrics;
        differing = fmt::format("{}", metrics.counts.differing);
        largest = number(metrics.all.max());
        if (one.comparison->ssim && one.comparison->ssim->value)
            ssim = fmt::format("{:.5f}", *one.comparison->ssim->value);
        if (one.comparison->seams) {
            seams = number(one.comparison->seams->seam_steps.mean_step);
            controls = number(one.comparison->seams->control_steps.mean_step);
        }
    }
    if (one.judgement) {
        found = number(one.judgement->step.detectable);
        quiet = fmt::format("{} of {}", one.judgement->quiet.renders - one.judgement->quiet.alarms,
                            one.judgement->quiet.renders);
    }
    fmt::format_to(out, "{:<{}}  {:<16}{:<4}{:>10}{:>9}{:>9}{:>10}{:>10}{:>10}{:>10}\n", one.name,
                   width, to_string(one.verdict.kind), one.verdict.ok ? "ok" : "NO", differing,
                   largest, ssim, seams, controls, found, quiet);
    if (!one.verdict.ok || one.verdict.kind == Verdict::Kind::differs)
        fmt::format_to(out, "{:<{}}  {}\n", "", width, one.verdict.why);
}

}  // namespace

std::string to_table(const NoiseReport& noise, const std::string& unit) {
    std::string text;
    const auto out = std::back_inserter(text);
    if (noise.renders.empty()) {
        fmt::format_to(out, "no noise: {}\n", noise.why_not);
        return text;
    }
    fmt::format_to(out,
                   "Serial renders in another order, against the serial reference ({})\n"
                   "  {:<24}{:>10}{:>12}{:>12}{:>10}\n",
                   unit, "", "differing", "mean", "RMS", "largest");
    for (const NoiseRender& render : noise.renders) {
        const Metrics& metrics = render.comparison.metrics;
        fmt::format_to(out, "  {:<24}{:>10}{:>12}{:>12}{:>10}\n", render.render.name,
                       metrics.counts.differing, number(metrics.all.mean_abs()),
                       number(metrics.all.rms()), number(metrics.all.max()));
    }
    if (noise.floor)
        fmt::format_to(out,
                       "sigma of a sample: {} in the mean, {:.4g} at most (x {}, y {}); {} of {} "
                       "samples are not the same in all {} renders\n",
                       number(noise.floor->sigma), noise.floor->largest_sigma, noise.floor->x,
                       noise.floor->y, noise.floor->noisy, noise.floor->samples,
                       noise.floor->renders);
    if (!noise.why_not.empty()) fmt::format_to(out, "{}\n", noise.why_not);
    return text;
}

std::string to_table(const SeamsReport& report) {
    std::string text;
    const auto out = std::back_inserter(text);
    const std::string unit = report.image && report.image->integer() ? "levels" : "values";
    fmt::format_to(out, "{}", report.serial ? report.serial->scene.name : "no scene");
    if (report.image)
        fmt::format_to(out, ", {} x {} pixels, {}, {}", report.image->width, report.image->height,
                       fmt::join(report.image->channels, ","), report.image->depth);
    fmt::format_to(out, "\n\n");
    if (report.serial) fmt::format_to(out, "{}\n", to_table(report.serial->noise, unit));
    std::size_t width = 8;
    for (const SeamsCase& one : report.cases) width = std::max(width, one.name.size());
    fmt::format_to(out, "{:<{}}  {:<20}{:>10}{:>9}{:>9}{:>10}{:>10}{:>10}{:>10}\n", "case", width,
                   "verdict", "differing", "largest", "SSIM", "step", "control", "findable",
                   "quiet on");
    for (const SeamsCase& one : report.cases) case_row(out, one, width);
    if (report.conditioning) {
        const auto& [found, failure] = *report.conditioning;
        if (found.verdict)
            fmt::format_to(out, "\nThe scene is {}: {}\n", to_string(found.verdict->kind),
                           found.verdict->why);
        else
            fmt::format_to(out, "\nHow well-conditioned the scene is cannot be said: {}\n",
                           failure);
    }
    for (const SkippedCase& one : report.skipped)
        fmt::format_to(out, "{:<{}}  left out: {}\n", one.name, width, one.why);
    fmt::format_to(out,
                   "\nErrors in {}. step, control: mean step of the signed error at the seams, and "
                   "midway between them. findable: how much more than in equally right renders the "
                   "step at a seam must be to be called damage. quiet on: how many of the equally "
                   "right renders, each "
                   "judged against the others at these seams, raise no alarm.\n",
                   unit);
    return text;
}

}  // namespace mpipov
