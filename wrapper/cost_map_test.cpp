#include "cost_map.h"

#include <gmock/gmock.h>

#include <random>
#include <stdexcept>

namespace mpipov {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(CostMap, WithinARectangleCostsGoByArea) {
    const CostMap map({0, 0, 10, 10}, {{{0, 0, 10, 5}, 50}, {{5, 5, 10, 10}, 100}});
    EXPECT_DOUBLE_EQ(map.cpu_seconds(), 150);
    EXPECT_DOUBLE_EQ(map.cpu_seconds({0, 0, 10, 1}), 10);
    EXPECT_DOUBLE_EQ(map.cpu_seconds({0, 5, 5, 10}), 0);
    EXPECT_DOUBLE_EQ(map.cpu_seconds({4, 4, 6, 6}), 2 + 4);
    EXPECT_DOUBLE_EQ(map.cpu_seconds({-3, -3, 99, 99}), 150);
    EXPECT_DOUBLE_EQ(map.cpu_seconds({20, 0, 30, 10}), 0);
}

TEST(CostMap, ARegionNeedNotBeginAtTheCorner) {
    const CostMap map = uniform_costs({5, 7, 15, 17}, 100);
    EXPECT_DOUBLE_EQ(map.cpu_seconds({5, 7, 10, 12}), 25);
    EXPECT_DOUBLE_EQ(map.cpu_seconds({0, 0, 6, 8}), 1);
}

TEST(CostMap, ACutOfTheImageCostsWhatTheWholeDoes) {
    const Rect image{0, 0, 331, 217};
    const CostMap map = hill_costs(image, 12);
    EXPECT_NEAR(map.cpu_seconds(), 12, 1e-9);
    for (const Shape shape : {Shape::columns, Shape::rows, Shape::tiles}) {
        GridRequest grid{image, shape, Seams::plain, 13, 0, 32};
        double sum = 0;
        for (const Section& section : make_partition(grid).sections)
            sum += map.cpu_seconds(section.keep);
        EXPECT_NEAR(sum, 12, 1e-9);
    }
    // Ten to one, where it is steepest.
    EXPECT_GT(map.cpu_seconds({165, 130, 166, 131}), 6 * map.cpu_seconds({0, 0, 1, 1}));
}

TEST(CostMap, EveryCutGivesTheSumOfItsPixels) {
    const CostMap map = hill_costs({3, 2, 40, 33}, 7);
    std::mt19937 random(3);
    for (int round = 0; round < 50; ++round) {
        const int x = 3 + static_cast<int>(random() % 30), y = 2 + static_cast<int>(random() % 25);
        const Rect rect{x, y, x + 1 + static_cast<int>(random() % 7),
                        y + 1 + static_cast<int>(random() % 6)};
        double sum = 0;
        for (int j = rect.y0; j < rect.y1; ++j)
            for (int i = rect.x0; i < rect.x1; ++i) sum += map.cpu_seconds({i, j, i + 1, j + 1});
        EXPECT_NEAR(map.cpu_seconds(rect), sum, 1e-9);
    }
}

TEST(CostMap, OfARunIsWithoutItsLaunches) {
    RunRecord record;
    record.plan.region = {0, 0, 20, 10};
    EXPECT_THROW(costs_of_run(record, 0), std::invalid_argument);
    for (int i = 0; i < 2; ++i) {
        SectionRecord section;
        section.section = {i, {10 * i, 0, 10 * i + 10, 10}, {10 * i, 0, 10 * i + 10, 10}};
        section.cpu_seconds = i == 0 ? 1.5 : 0.25;
        record.sections.push_back(section);
    }
    const CostMap map = costs_of_run(record, 0.5);
    EXPECT_DOUBLE_EQ(map.cpu_seconds({0, 0, 10, 10}), 1);
    EXPECT_DOUBLE_EQ(map.cpu_seconds({10, 0, 20, 10}), 0) << "not less than nothing";
}

TEST(CostMap, IsReadFromJsonAndRefusesWhatIsNone) {
    const json good = {{"format", "mpipov-costs"},
                       {"version", 1},
                       {"width", 20},
                       {"height", 10},
                       {"rectangles",
                        {{{"x0", 0}, {"y0", 0}, {"x1", 20}, {"y1", 5}, {"cpu_seconds", 4}},
                         {{"x0", 0}, {"y0", 5}, {"x1", 20}, {"y1", 10}, {"cpu_seconds", 2}}}}};
    EXPECT_DOUBLE_EQ(cost_map_from_json(good).cpu_seconds(), 6);
    const auto refused = [&](const char* where, const json& value, const char* why) {
        json bad = good;
        bad[json::json_pointer(where)] = value;
        try {
            cost_map_from_json(bad);
            ADD_FAILURE() << where;
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), HasSubstr(why)) << where;
        }
    };
    refused("/format", "mpipov-run", "mpipov-costs");
    refused("/version", 2, "version 1");
    refused("/width", 0, "at least one pixel");
    refused("/rectangles/0/x1", "wide", "its 'x1': must be a whole number");
    refused("/width", 4294967336, "out of range");
    refused("/rectangles", 7, "it lacks");
    refused("/rectangles/0/x1", 21, "within the image");
    refused("/rectangles/0/y1", 6, "overlaps");
    refused("/rectangles/1/cpu_seconds", -1, "less than nothing");
    EXPECT_THROW(read_cost_map("/nowhere/costs.json"), std::runtime_error);
}

TEST(CostMap, StretchesToAnotherSize) {
    const CostMap small({0, 0, 40, 30}, {{{0, 0, 10, 30}, 3}, {{10, 0, 40, 30}, 1}});
    const CostMap large = stretched(small, {0, 0, 400, 300});
    EXPECT_NEAR(large.cpu_seconds(), 400, 1e-9) << "a hundred times the pixels";
    EXPECT_NEAR(large.cpu_seconds({0, 0, 100, 300}), 300, 1e-9);
    const CostMap odd = stretched(small, {3, 5, 16, 12});
    EXPECT_EQ(odd.region(), (Rect{3, 5, 16, 12}));
    EXPECT_NEAR(odd.cpu_seconds(), 4.0 * 13 * 7 / 1200, 1e-9);
}

}  // namespace
}  // namespace mpipov
