#include "overlap.h"
#include "partition_test_support.h"

namespace mpipov {
namespace {

constexpr int most_sections_tried = 400;

TEST(SectionProperty, EveryPixelHasOneOwner) {
    for_rounds(3000, [](Random& random) {
        RandomGrid grid = random_grid(random);
        const long long most = max_sections(grid.request);
        const int tried = static_cast<int>(std::min<long long>(most, most_sections_tried));
        grid.request.sections = random.one_in(4) ? tried : random.between(1, tried);
        const Partition partition = make_partition(grid.request);
        expect_sound(partition);
        expect_sound_seams(partition);
        expect_sound_launches(partition, grid.image);
    });
}

// All that a grid holds: strips and tiles of one unit, one pixel wide with other seams than
// aligned.
TEST(SectionProperty, AsManySectionsAsThereAreUnits) {
    for_rounds(300, [](Random& random) {
        RandomGrid grid = random_grid(random);
        while (max_sections(grid.request) > 5000) grid = random_grid(random);
        grid.request.sections = static_cast<int>(max_sections(grid.request));
        const Partition partition = make_partition(grid.request);
        expect_sound(partition);
        expect_sound_launches(partition, grid.image);
        grid.request.sections += 1;
        ASSERT_THROW(make_partition(grid.request), std::invalid_argument);
    });
}

// A seam that is rendered again is kept around its line and nowhere else, whatever the halo.
TEST(SectionProperty, ARepairLiesAroundItsSeam) {
    for_rounds(300, [](Random& random) {
        RandomGrid grid = random_grid(random);
        grid.request.sections =
            static_cast<int>(std::min<long long>(max_sections(grid.request), 50));
        const Rect region = grid.request.region;
        for (const Seam& seam : find_seams(make_partition(grid.request).sections)) {
            const int halo =
                random.one_in(10) ? std::numeric_limits<int>::max() : random.between(1, 64);
            const Section repair = repair_section(7, seam, halo, region);
            ASSERT_FALSE(repair.keep.empty());
            ASSERT_EQ(intersect(repair.keep, region), repair.keep);
            ASSERT_EQ(intersect(repair.render, region), repair.render);
            ASSERT_EQ(intersect(repair.keep, repair.render), repair.keep);
            const Rect sides = seam.vertical
                                   ? Rect{seam.position - 1, seam.from, seam.position + 1, seam.to}
                                   : Rect{seam.from, seam.position - 1, seam.to, seam.position + 1};
            ASSERT_EQ(intersect(sides, repair.keep), sides);
        }
    });
}

// Images of more pixels than an int counts.
TEST(SectionProperty, TheLargestImages) {
    constexpr int side = 65536;
    for (const Shape shape : {Shape::columns, Shape::rows, Shape::tiles})
        for (const Seams seams : {Seams::aligned, Seams::halo, Seams::plain}) {
            const GridRequest request{{0, 0, side, side}, shape, seams, 1000, 2, 32};
            const Partition partition = make_partition(request);
            expect_sound(partition);
            expect_sound_seams(partition);
        }
    EXPECT_EQ(max_sections({{0, 0, side, side}, Shape::tiles, Seams::plain}), 1LL << 32);
    constexpr int largest = std::numeric_limits<int>::max();
    for (const Seams seams : {Seams::aligned, Seams::halo, Seams::plain}) {
        const GridRequest request{
            {0, 0, largest, 3}, Shape::columns, seams, 1000, largest, largest};
        GridRequest possible = request;
        possible.sections = static_cast<int>(std::min(1000LL, max_sections(request)));
        expect_sound(make_partition(possible));
    }
}

}  // namespace
}  // namespace mpipov
