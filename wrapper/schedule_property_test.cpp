// The schedule against a model, whatever comes in whatever order; and on a virtual clock.
#include "property_test_support.h"
#include "schedule.h"
#include "virtual_run.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace mpipov {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

double any_number(Random& random) {
    return random.one_of(
        std::vector{0.0, 0.0, 1.0, 1.0, 2.0, 1e-300, 1e300, infinite, -infinite, -1.0, nan});
}

// What a coordinator does with a schedule, at random, and what must be true of it meanwhile.
class Model {
  public:
    explicit Model(Random& random)
        : random_(random),
          policy_(random.one_of(std::vector{Policy::static_, Policy::dynamic, Policy::cost})),
          lanes_(draw_lanes(random)),
          sections_(random.between(1, 40)),
          schedule_(policy_, ids(), lanes_, draw_costs()) {
        for (int section = 0; section < sections_; ++section) left_.insert(section);
    }

    void run() {
        for (int section = 0; section < sections_; ++section)  // what an earlier run finished
            if (random_.one_in(8)) finish(section);
        constexpr int most_steps = 20'000;
        for (int i = 0; i < most_steps && !left_.empty(); ++i) {
            step();
            if (testing::Test::HasFatalFailure()) return;
            ASSERT_EQ(schedule_.unfinished(), static_cast<int>(left_.size()));
            ASSERT_EQ(schedule_.all_finished(), left_.empty());
        }
        ASSERT_TRUE(left_.empty()) << "sections that nobody was given";
        for (int worker = 0; worker < workers(); ++worker)
            ASSERT_EQ(schedule_.next(worker), std::nullopt);
    }

  private:
    static std::vector<int> draw_lanes(Random& random) {
        std::vector<int> lanes;
        for (int workers = random.between(1, 6); workers > 0; --workers)
            lanes.push_back(random.between(0, 3));
        if (std::accumulate(lanes.begin(), lanes.end(), 0) == 0) lanes.back() = 1;
        return lanes;
    }
    std::vector<int> ids() const {
        std::vector<int> all(static_cast<std::size_t>(sections_));
        std::iota(all.begin(), all.end(), 0);
        return all;
    }
    std::vector<double> draw_costs() {
        if (random_.one_in(4)) return {};
        for (int i = 0; i < sections_; ++i) costs_.push_back(any_number(random_));
        return costs_;
    }
    int workers() const { return static_cast<int>(lanes_.size()); }
    double cost(int section) const {
        const auto i = static_cast<std::size_t>(section);
        return i < costs_.size() && costs_[i] > 0 ? costs_[i] : 0;
    }

    void finish(int section) {
        schedule_.finished(section);
        left_.erase(section);
    }

    void step() {
        switch (random_.between(0, 9)) {
            case 0:
            case 1:
            case 2:
                return take(random_.between(0, workers() - 1));
            case 3:
                return copy(random_.between(0, workers() - 1));
            case 4:
                return fail();
            case 5:
                return add_or_expect();
            default:
                return succeed();
        }
    }

    void take(int worker) {
        const auto next = schedule_.next(worker);
        if (!next) return expect_reason(worker);
        ASSERT_GT(lanes_[static_cast<std::size_t>(worker)], 0);
        ASSERT_EQ(left_.count(*next), 1U) << "it was finished";
        ASSERT_TRUE(on_[*next].empty()) << "it is under way";
        if (policy_ == Policy::cost && failed_[*next].empty())
            for (const int other : left_) {
                const bool waits = on_[other].empty() && failed_[other].empty();
                ASSERT_LE(waits ? cost(other) : 0, cost(*next)) << "the longest comes first";
            }
        begin(*next, worker);
    }

    // Where a worker gets nothing although nothing is under way, somebody else does.
    void expect_reason(int worker) {
        for (const int section : left_)
            if (!on_[section].empty()) return;
        if (left_.empty()) return;
        for (int other = 0; other < workers(); ++other) {
            if (other == worker) continue;
            if (const auto next = schedule_.next(other)) return begin(*next, other);
        }
        FAIL() << "nobody is given what is left";
    }

    void begin(int section, int worker) {
        on_[section].push_back(worker);
        ASSERT_EQ(schedule_.attempts(section), ++attempts_[section]);
    }

    void copy(int worker) {
        std::map<int, Outlook> outlooks;
        const auto next = schedule_.next_copy(worker, [&](int section) {
            return outlooks[section] = {any_number(random_), any_number(random_)};
        });
        if (!next) return;
        ASSERT_NE(policy_, Policy::static_);
        ASSERT_EQ(left_.count(*next), 1U);
        ASSERT_EQ(on_[*next].size(), 1U);
        ASSERT_NE(on_[*next][0], worker);
        ASSERT_LT(outlooks[*next].anew, outlooks[*next].left);
        for (const auto& [section, outlook] : outlooks) {
            const double left = outlook.anew < outlook.left ? outlook.left : 0;
            ASSERT_LE(left, outlooks[*next].left);
        }
        begin(*next, worker);
    }

    std::vector<int> under_way() const {
        std::vector<int> sections;
        for (const auto& [section, on] : on_)
            if (!on.empty()) sections.push_back(section);
        return sections;
    }

    void fail() {
        const auto sections = under_way();
        if (sections.empty()) return;
        const int section = random_.one_of(sections), worker = random_.one_of(on_[section]);
        schedule_.failed(section, worker);
        std::erase(on_[section], worker);
        failed_[section].insert(worker);
        ASSERT_EQ(schedule_.failures(section), ++failures_[section]);
    }

    // The first result counts, the other launch is told to end.
    void succeed() {
        const auto sections = under_way();
        if (sections.empty()) return;
        const int section = random_.one_of(sections), winner = random_.one_of(on_[section]);
        for (const int worker : on_[section])
            if (worker != winner) schedule_.stopped(section, worker);
        on_.erase(section);
        finish(section);
    }

    void add_or_expect() {
        if (sections_ < 60 && random_.one_in(5)) {
            if (!costs_.empty()) costs_.push_back(0);
            left_.insert(sections_);
            return schedule_.add(sections_++);
        }
        const int section = random_.between(0, sections_ - 1);
        if (attempts_[section] > 0 || costs_.empty()) return;
        const double better = any_number(random_);
        costs_[static_cast<std::size_t>(section)] = better;
        schedule_.expect(section, better);
    }

    Random& random_;
    Policy policy_;
    std::vector<int> lanes_;
    int sections_;
    std::vector<double> costs_;
    Schedule schedule_;
    std::set<int> left_;
    std::map<int, std::vector<int>> on_;  // workers, by section
    std::map<int, std::set<int>> failed_;
    std::map<int, int> attempts_, failures_;
};

TEST(ScheduleProperty, EverySectionIsFinishedOnceInAnyOrderOfEvents) {
    for_rounds(3000, [](Random& random) { Model(random).run(); });
}

TEST(ScheduleProperty, InfiniteCostsComeFirstAndNoNumbersLast) {
    std::vector<int> ids(6);
    std::iota(ids.begin(), ids.end(), 0);
    Schedule schedule(Policy::cost, ids, {6}, {nan, 1, infinite, -5, 1e300, 0});
    std::vector<int> order;
    while (const auto section = schedule.next(0)) order.push_back(*section);
    EXPECT_THAT(order, testing::ElementsAre(2, 4, 1, 0, 3, 5));
}

TEST(ScheduleProperty, NothingIsCopiedForAnOutlookThatIsNoNumber) {
    for (const Outlook outlook : {Outlook{nan, 1}, {nan, nan}, {5, nan}, {infinite, infinite}}) {
        Schedule schedule(Policy::dynamic, {0}, {1, 1});
        ASSERT_EQ(schedule.next(0), 0);
        EXPECT_EQ(schedule.next_copy(1, [&](int) { return outlook; }), std::nullopt);
    }
}

// A run is never shorter than its work and its longest section, every section ends, and with equal
// ranks and nothing else to wait for no list schedule takes more than twice as long (Graham 1966).
TEST(ScheduleProperty, AVirtualRunOfAnyCosts) {
    for_rounds(600, [](Random& random) {
        VirtualRun run;
        run.policy = random.one_of(std::vector{Policy::static_, Policy::dynamic, Policy::cost});
        double all = 0, longest = 0;
        for (int i = random.between(1, 60); i > 0; --i) {
            run.section_cpu.push_back(random.one_of(
                std::vector{0.0, 5e-324, 1e-300, 1e-6, 1.0, 1.0, 3.0, 7.0, 1e6, 1e13}));
            all += run.section_cpu.back();
            longest = std::max(longest, run.section_cpu.back());
            run.expected.push_back(any_number(random));
        }
        run.ranks.resize(static_cast<std::size_t>(random.between(1, 9)));
        run.terms.copies = random.one_in(2);
        const auto ranks = static_cast<double>(run.ranks.size());
        const VirtualOutcome outcome = run_virtually(run);
        ASSERT_GE(outcome.wall_seconds * (1 + 1e-9), std::max(longest, all / ranks));
        if (run.policy != Policy::static_ && !run.terms.copies) {
            ASSERT_LE(outcome.wall_seconds, (longest + all / ranks) * (1 + 1e-9));
        }
        for (const VirtualSection& section : outcome.sections) {
            ASSERT_GE(section.rank, 0);
            ASSERT_GE(section.end, section.start);
        }
    });
}

TEST(ScheduleProperty, AVirtualRunWithoutAnEndIsRefused) {
    VirtualRun run;
    run.section_cpu = {1, 1};
    run.ranks.resize(1);
    for (const double seconds : {-1.0, nan, infinite, 1e300}) {
        run.section_cpu[1] = seconds;
        EXPECT_THROW(run_virtually(run), std::invalid_argument) << seconds;
    }
    run.section_cpu[1] = 1e15;
    run.ranks[0].speed = 1e-300;
    EXPECT_THROW(run_virtually(run), std::invalid_argument);
    run.ranks[0].speed = 1;
    run.terms.network = VirtualNetwork{0, 1e6, {1, nan}};
    EXPECT_THROW(run_virtually(run), std::invalid_argument);
}

}  // namespace
}  // namespace mpipov
