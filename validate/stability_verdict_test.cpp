#include "stability_verdict.h"

#include "seam_verdict.h"

#include <gmock/gmock.h>

namespace mpipov {
namespace {

using testing::HasSubstr;

ConditioningFacts facts(long long smallest, long long middle, long long largest) {
    return {10000, {{1e-12, smallest, 5}, {1e-9, middle, 5}, {1e-6, largest, 5}}, false, {}};
}

Conditioning kind(const ConditioningFacts& of) {
    return judge_conditioning(of).kind;
}

TEST(StabilityVerdict, TheSmallestMoveThatTooManyAnswerDecides) {
    EXPECT_EQ(kind(facts(0, 0, 0)), Conditioning::well);
    EXPECT_EQ(kind(facts(0, 0, 5000)), Conditioning::well);
    EXPECT_EQ(kind(facts(0, 1, 5000)), Conditioning::spots);
    EXPECT_EQ(kind(facts(10, 10, 5000)), Conditioning::spots);
    EXPECT_EQ(kind(facts(10, 11, 5000)), Conditioning::sensitive);
    EXPECT_EQ(kind(facts(11, 0, 0)), Conditioning::ill);
    EXPECT_TRUE(is_well(Conditioning::spots));
    EXPECT_FALSE(is_well(Conditioning::sensitive));
    EXPECT_THAT(judge_conditioning(facts(11, 3000, 0)).why, HasSubstr("11 of 10000 pixels"));
}

TEST(StabilityVerdict, RandomNumbersDealtAnewAreNoAnswer) {
    ConditioningFacts of = facts(500, 500, 500);
    of.order_dependent = true;
    EXPECT_EQ(kind(of), Conditioning::untold) << "nothing is known of the noise";
    of.noise = 2.6;
    EXPECT_EQ(kind(of), Conditioning::untold);
    of.noise = 2.4;
    EXPECT_EQ(kind(of), Conditioning::ill) << "more than noise";
    of = facts(0, 3, 500);
    of.order_dependent = true;
    EXPECT_EQ(kind(of), Conditioning::spots) << "few answer: noise does not matter";
}

TEST(StabilityVerdict, MovesByName) {
    EXPECT_EQ(move_text(1e-12), "1e-12");
    EXPECT_EQ(move_text(1e-9), "1e-9");
    EXPECT_EQ(move_text(1e-3), "1e-3");
    EXPECT_EQ(move_text(0), "0");
}

TEST(StabilityVerdict, SeamsAreBlamedForWhatTheSceneDoesNotExplain) {
    const Verdict blamed{Verdict::Kind::differs, false, "7 pixels differ"};
    EXPECT_EQ(reconsidered(blamed, "why", {7, 0}).kind, Verdict::Kind::ill_conditioned);
    EXPECT_TRUE(reconsidered(blamed, "why", {7, 0}).ok);
    const Verdict kept = reconsidered(blamed, "why", {7, 1});
    EXPECT_EQ(kept.kind, Verdict::Kind::differs);
    EXPECT_FALSE(kept.ok);
    EXPECT_THAT(kept.why, HasSubstr("1 of the 7 pixels"));
}

}  // namespace
}  // namespace mpipov
