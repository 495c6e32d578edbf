#include "stability_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mpipov {
namespace {

bool too_many(const MoveAnswered& answer, long long pixels) {
    return answer.answering * one_may_answer_in > pixels;
}

// Random numbers dealt anew change a picture as much as another order does; of that there are a few
// renders only, and none of them is the most that it can be.
constexpr double most_by_chance = 2;

bool is_nothing(const MoveAnswered& answer) {
    return answer.move <= next_to_nothing;
}

std::string pixels_of(long long count) {
    return count == 1 ? "1 pixel answers" : fmt::format("{} pixels answer", count);
}

// The rule for pictures that do not depend on the order of rendering.
ConditioningVerdict plain_verdict(const ConditioningFacts& facts) {
    const MoveAnswered* worst = nullptr;
    for (const MoveAnswered& answer : facts.answers) {
        if (!is_nothing(answer)) continue;
        if (too_many(answer, facts.pixels)) {
            const bool least = &answer == &facts.answers.front();
            const std::string found = fmt::format(
                "{} of {} pixels change by more than a level of 255 where the camera "
                "moves by {}",
                answer.answering, facts.pixels, move_text(answer.move));
            return least ? ConditioningVerdict{Conditioning::ill, found + ": rounding decides"}
                         : ConditioningVerdict{
                               Conditioning::sensitive,
                               fmt::format("{}, but {} by {}: it shrinks with the move", found,
                                           facts.answers.front().answering,
                                           move_text(facts.answers.front().move))};
        }
        if (answer.answering > 0 && (worst == nullptr || answer.answering > worst->answering))
            worst = &answer;
    }
    if (worst == nullptr)
        return {Conditioning::well,
                fmt::format("no pixel answers a move of {} or less", move_text(next_to_nothing))};
    return {Conditioning::spots,
            fmt::format("{} a move of {}, of {}: no more than one in {} may lie on an edge",
                        pixels_of(worst->answering), move_text(worst->move), facts.pixels,
                        one_may_answer_in)};
}

}  // namespace

std::string to_string(Conditioning conditioning) {
    switch (conditioning) {
        case Conditioning::well:
            return "well-conditioned";
        case Conditioning::spots:
            return "well-conditioned but for spots";
        case Conditioning::sensitive:
            return "sensitive";
        case Conditioning::ill:
            return "ill-conditioned";
        case Conditioning::untold:
            break;
    }
    return "cannot be told from noise";
}

bool is_well(Conditioning conditioning) {
    return conditioning == Conditioning::well || conditioning == Conditioning::spots;
}

bool answers_nothing(const ConditioningFacts& facts) {
    return std::any_of(facts.answers.begin(), facts.answers.end(), [&](const MoveAnswered& answer) {
        return is_nothing(answer) && too_many(answer, facts.pixels);
    });
}

ConditioningVerdict judge_conditioning(const ConditioningFacts& facts) {
    ConditioningVerdict verdict = plain_verdict(facts);
    if (!facts.order_dependent || !answers_nothing(facts)) return verdict;
    double mean = 0;
    for (const MoveAnswered& answer : facts.answers)
        if (is_nothing(answer)) mean = std::max(mean, answer.mean);
    if (!facts.noise)
        return {Conditioning::untold,
                verdict.why +
                    ", but the scene depends on the order of rendering, and too few different "
                    "serial renders exist to tell that apart"};
    if (mean > most_by_chance * *facts.noise) return verdict;
    return {Conditioning::untold,
            fmt::format("{}, by {:.3g} in the mean, and by up to {:.3g} where only the order of "
                        "rendering is another: the move deals other random numbers",
                        verdict.why, mean, *facts.noise)};
}

std::string move_text(double move) {
    return move == 0 ? "0" : fmt::format("1e{}", static_cast<int>(std::lround(std::log10(move))));
}

}  // namespace mpipov
