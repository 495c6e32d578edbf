// How well-conditioned a scene is: what its picture makes of a camera that has moved by next to
// nothing. Pure.
//
// A pixel answers a move where it changes by more than one level of 255. A smooth picture is moved
// by m times its own size, so only edges within that of a sample answer: of W pixels a row, m W of
// those at edges, one in 10^7 at m = 1e-9 and W = 100. Some few always may, where a sample lies on
// an edge by construction. One in a thousand is some thousand times more than that, and 1e-12 is
// still some thousand times what a double rounds off.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mpipov {

enum class Conditioning {
    well,       // no pixel answers 1e-9 or less
    spots,      // some pixels do, no more than one in a thousand
    sensitive,  // more than one in a thousand answer 1e-9, not so many 1e-12: it shrinks with the
                // move
    ill,        // more than one in a thousand answer 1e-12: rounding decides about them
    untold,     // they do, but by no more than twice what equally right renders differ by
};
std::string to_string(Conditioning conditioning);
bool is_well(Conditioning conditioning);  // well or spots

struct MoveAnswered {
    double move = 0;
    long long answering = 0;  // pixels
    double mean = 0;          // absolute error, stored units
};

struct ConditioningFacts {
    long long pixels = 0;
    std::vector<MoveAnswered> answers;  // smallest move first
    bool order_dependent = false;
    // The largest mean absolute error between equally right renders; none: not measured.
    std::optional<double> noise;
};

struct ConditioningVerdict {
    Conditioning kind = Conditioning::well;
    std::string why;  // one sentence
};

// The largest move that counts as nothing.
inline constexpr double next_to_nothing = 1e-9;
// Pixels of an image, one in this many, that may answer it.
inline constexpr long long one_may_answer_in = 1000;

// Whether more than that answer a move of next to nothing.
bool answers_nothing(const ConditioningFacts& facts);

// In a scene that depends on the order of rendering one pixel that answers deals other random
// numbers to all that come after it. There `noise` has to be known to tell the two apart, where
// answers_nothing().
ConditioningVerdict judge_conditioning(const ConditioningFacts& facts);

// "1e-9"
std::string move_text(double move);

}  // namespace mpipov
