// What is said of one image that was rendered in sections. Pure.
#pragma once

#include "answer_map.h"
#include "seam_judge.h"
#include "section.h"

#include <optional>
#include <string>

namespace mpipov {

struct Verdict {
    enum class Kind { identical, within_noise, ill_conditioned, beyond_noise, differs, failed };
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

// Of an ill-conditioned scene (`why`: what makes it one), whose pixels differ as `found`. Where its
// picture answers next to nothing by as much everywhere, the seams are not to be blamed for it, and
// it is ok; else the verdict stands, and says so.
Verdict reconsidered(const Verdict& verdict, const std::string& why,
                     const AnswerMap::Differing& found);

}  // namespace mpipov
