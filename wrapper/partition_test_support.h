// What must hold of every partition, however large, and random requests for one.
#pragma once

#include "povray_command.h"
#include "property_test_support.h"
#include "section.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <vector>

namespace mpipov {

struct RandomGrid {
    ImageSize image;
    GridRequest request;
};

// Of images from one pixel to 65536 x 65536, whole or a part, and of blocks and halos larger than
// any image. `request.sections` is 1.
inline RandomGrid random_grid(Random& random) {
    constexpr int largest = std::numeric_limits<int>::max();
    const int most = random.one_of(std::vector{3, 40, 40, 300, 300, 4096, 65536});
    RandomGrid grid;
    grid.image = {random.between(1, most), random.between(1, most)};
    GridRequest& request = grid.request;
    request.region = {0, 0, grid.image.width, grid.image.height};
    if (random.one_in(2)) {
        Rect& region = request.region;
        region.x0 = random.between(0, grid.image.width - 1);
        region.y0 = random.between(0, grid.image.height - 1);
        region.x1 = random.between(region.x0 + 1, grid.image.width);
        region.y1 = random.between(region.y0 + 1, grid.image.height);
    }
    request.shape = random.one_of(std::vector{Shape::columns, Shape::rows, Shape::tiles});
    request.seams = random.one_of(std::vector{Seams::aligned, Seams::halo, Seams::plain});
    request.block = random.one_in(20) ? largest - random.between(0, 40) : random.between(1, 64);
    request.halo = random.one_in(20) ? largest - random.between(0, 40) : random.between(0, 8);
    request.sections = 1;
    return grid;
}

inline bool on_grid(int at, int begin, int end, const GridRequest& request) {
    return at == end || request.seams != Seams::aligned || (at - begin) % request.block == 0;
}

// Every pixel of the region belongs to exactly one section: they are not empty, lie within it, do
// not overlap and have its area together. With halo seams, what is rendered is what is kept and so
// many pixels more on every side, but for the region's edges; else nothing more.
inline void expect_sound(const Partition& partition) {
    const GridRequest& request = partition.request;
    const Rect& region = request.region;
    long long area = 0;
    std::vector<const Section*> by_top;
    for (const Section& section : partition.sections) {
        const Rect& keep = section.keep;
        ASSERT_EQ(section.id, static_cast<int>(by_top.size()));
        ASSERT_FALSE(keep.empty());
        ASSERT_EQ(intersect(keep, region), keep);
        for (const auto& [at, begin, end] : {std::tuple{keep.x0, region.x0, region.x1},
                                             {keep.x1, region.x0, region.x1},
                                             {keep.y0, region.y0, region.y1},
                                             {keep.y1, region.y0, region.y1}})
            ASSERT_TRUE(on_grid(at, begin, end, request));
        const long long halo = request.seams == Seams::halo ? request.halo : 0;
        ASSERT_EQ(section.render.x0, std::max<long long>(region.x0, keep.x0 - halo));
        ASSERT_EQ(section.render.y0, std::max<long long>(region.y0, keep.y0 - halo));
        ASSERT_EQ(section.render.x1, std::min<long long>(region.x1, keep.x1 + halo));
        ASSERT_EQ(section.render.y1, std::min<long long>(region.y1, keep.y1 + halo));
        area += keep.area();
        by_top.push_back(&section);
    }
    ASSERT_EQ(area, region.area());
    ASSERT_EQ(partition.sections.size(), static_cast<std::size_t>(request.sections));
    // Ids follow the top-left corners, so only those that begin before a section's end may overlap.
    for (std::size_t i = 0; i < by_top.size(); ++i)
        for (std::size_t j = i + 1; j < by_top.size(); ++j) {
            const Rect &a = by_top[i]->keep, &b = by_top[j]->keep;
            ASSERT_TRUE(std::pair(a.y0, a.x0) < std::pair(b.y0, b.x0));
            if (b.y0 >= a.y1) break;
            ASSERT_TRUE(intersect(a, b).empty());
        }
}

// Every inner edge is a seam, once: together the sections' edges are the region's and twice the
// seams. And a seam lies where its two sections say.
inline void expect_sound_seams(const Partition& partition) {
    const auto around = [](const Rect& r) { return 2LL * r.width() + 2LL * r.height(); };
    const Rect& region = partition.request.region;
    long long edges = 0, seams = 0;
    for (const Section& section : partition.sections) edges += around(section.keep);
    for (const Seam& seam : find_seams(partition.sections)) {
        const Rect& a = partition.sections[static_cast<std::size_t>(seam.a)].keep;
        const Rect& b = partition.sections[static_cast<std::size_t>(seam.b)].keep;
        ASSERT_LT(seam.from, seam.to);
        ASSERT_EQ(seam.vertical ? a.x1 : a.y1, seam.position);
        ASSERT_EQ(seam.vertical ? b.x0 : b.y0, seam.position);
        ASSERT_EQ(seam.vertical ? std::max(a.y0, b.y0) : std::max(a.x0, b.x0), seam.from);
        ASSERT_EQ(seam.vertical ? std::min(a.y1, b.y1) : std::min(a.x1, b.x1), seam.to);
        seams += seam.to - seam.from;
    }
    ASSERT_EQ(edges, around(region) + 2 * seams);
}

// What POV-Ray is told to render holds what is wanted, at most a column and a row more, and no
// argument is a 1, which would mean all of it.
inline void expect_sound_launches(const Partition& partition, const ImageSize& image) {
    const Rect frame{0, 0, image.width, image.height};
    for (const Section& section : partition.sections) {
        const Rect area = launch_area(section.render, image);
        ASSERT_EQ(intersect(area, section.render), section.render);
        ASSERT_EQ(intersect(area, frame), area);
        ASSERT_LE(area.width(), section.render.width() + 1);
        ASSERT_LE(area.height(), section.render.height() + 1);
        for (const std::string& argument : area_arguments(area)) {
            const bool is_across = argument[2] == 'C';
            const bool is_end = argument[1] == 'E';
            if (is_end && (is_across ? image.width : image.height) == 1) continue;
            ASSERT_NE(std::atoi(argument.c_str() + 3), 1) << argument;
        }
    }
}

}  // namespace mpipov
