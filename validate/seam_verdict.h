// What is said of one image that was rendered in sections. Pure.
#pragma once

#include "seam_judge.h"
#include "section.h"

#include <optional>
#include <string>

namespace mpipov {

struct Verdict {
    enum class Kind { identical, within_noise, beyond_noise, differs, failed };
    Kind kind = Kind::failed;
    bool ok = false;
    std::string why;  // one sentence
};
std::string to_string(Verdict::Kind kind);

struct VerdictRequest {
    bool identical = false;
    long long differing = 0;  // pixels
    Seams seams = Seams::aligned;
    bool sees_blocks = false;  // antialiasing of method 1, see serial_render.h
    // Its pixels do not depend on the order of rendering, but for few: is_exact (serial_set.h).
    bool exact_scene = false;
    // Of the section with the most: its pixels that differ, 0 to 1.
    double worst_section_share = 0;
    std::optional<Judgement> judgement;
};

// identical: ok. In an exact scene every difference is wrong, but for plain and halo seams with
// antialiasing of method 1: plain makes no promise there, and halo only comes close. In others the
// judgement says whether it is ok; without one nothing can be said and it is not.
// What antialiasing does at edges it does to few pixels of a section: over 121 scenes to 4.9 % at
// most (docs/seams.md). More than a quarter is damage, whatever the seams.
Verdict decide(const VerdictRequest& request);

}  // namespace mpipov
