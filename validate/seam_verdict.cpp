#include "seam_verdict.h"

#include <fmt/format.h>

namespace mpipov {
namespace {

std::string place(const Seam& line) {
    return fmt::format("{} = {}", line.vertical ? "x" : "y", line.position);
}

std::string why_beyond(const PixelTest& test) {
    const PixelOutlier& at = *test.at;
    return fmt::format(
        "{} samples are beyond {:.3g} sigma, the farthest at x {}, y {} ({:.4g}, "
        "expected {:.4g} with sigma {:.2g})",
        test.beyond, test.critical, at.x, at.y, at.value, at.expected, at.sigma);
}

std::string why_beyond(const StepTest& test) {
    if (test.beyond > 0)
        return fmt::format(
            "the step at the seam {} is {:.3g}, expected {:.3g}: {:.3g} sigma, "
            "allowed {:.3g}",
            place(test.at->line), test.step, test.expected, *test.largest, test.critical);
    return fmt::format(
        "the mean step at the seams is {:.3g}, in equally right renders {:.3g}: "
        "{:.3g} sigma, allowed {:.3g}",
        test.together->mean, test.together->expected, test.together->z, test.together->critical);
}

Verdict judged(const Judgement& judgement) {
    if (!judgement.alarm())
        return {Verdict::Kind::within_noise, true,
                fmt::format("no sample and no step is beyond what {} equally right renders show "
                            "(a step of {:.3g} more than theirs would be found)",
                            judgement.quiet.renders, judgement.step.detectable)};
    std::string why;
    if (judgement.pixel.alarm()) why = why_beyond(judgement.pixel);
    if (judgement.step.alarm()) {
        if (!why.empty()) why += "; ";
        why += why_beyond(judgement.step);
    }
    return {Verdict::Kind::beyond_noise, false, why};
}

}  // namespace

std::string to_string(Verdict::Kind kind) {
    switch (kind) {
        case Verdict::Kind::identical:
            return "identical";
        case Verdict::Kind::within_noise:
            return "within noise";
        case Verdict::Kind::ill_conditioned:
            return "ill-conditioned";
        case Verdict::Kind::beyond_noise:
            return "beyond noise";
        case Verdict::Kind::differs:
            return "differs";
        case Verdict::Kind::failed:
            break;
    }
    return "failed";
}

Verdict decide(const VerdictRequest& request) {
    if (request.identical)
        return {Verdict::Kind::identical, true, "no pixel differs from the serial render"};
    if (request.judgement) return judged(*request.judgement);
    const std::string found = fmt::format("{} pixels differ", request.differing);
    constexpr double most_of_a_section = 0.25;
    if (request.worst_section_share > most_of_a_section)
        return {Verdict::Kind::differs, false,
                fmt::format("{}, {:.0f} % of a section: more than antialiasing at its edges does",
                            found, 100 * request.worst_section_share)};
    if (!request.exact_scene)
        return {Verdict::Kind::differs, false,
                found + ", and too few different serial renders exist to tell noise from damage"};
    if (request.sees_blocks && request.seams == Seams::plain)
        return {Verdict::Kind::differs, true,
                found +
                    ": antialiasing of method 1 sees the sections' edges, and plain seams do "
                    "nothing about it"};
    if (request.sees_blocks && request.seams == Seams::halo)
        return {Verdict::Kind::differs, true,
                found +
                    ": antialiasing of method 1 can see farther than the halo, which comes "
                    "close and promises no more"};
    return {
        Verdict::Kind::differs, false,
        found +
            ", where the scene hardly depends on the order of rendering, if at all, and none may"};
}

Verdict reconsidered(const Verdict& verdict, const std::string& why,
                     const AnswerMap::Differing& found) {
    if (found.all > 0 && found.unexplained == 0)
        return {Verdict::Kind::ill_conditioned, true,
                fmt::format("{} pixels differ, none by more than the picture changes there or next "
                            "to it for nothing: the scene is ill-conditioned ({})",
                            found.all, why)};
    Verdict kept = verdict;
    kept.why += fmt::format(
        "; the scene is ill-conditioned, but {} of the {} pixels that differ "
        "do so by more than the picture changes there for nothing",
        found.unexplained, found.all);
    return kept;
}

}  // namespace mpipov
