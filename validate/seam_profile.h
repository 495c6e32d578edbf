// The errors of a stitched image by where they lie: by distance from the nearest seam, by section,
// along every seam, and on the serial render's own block edges. Pure: rows in, numbers out.
// Error = b - a in stored units, as in metrics.h. Pixels outside the rendered region belong to no
// section and to no seam; they are counted apart.
#pragma once

#include "metrics.h"
#include "seam_layout.h"
#include "seam_step.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace mpipov {

struct GroupErrors {
    PixelCounts counts;
    ErrorSums errors;
};

struct SectionErrors {
    Section section;
    GroupErrors group;
    Rect differing_box;  // empty where nothing differs
};

// A stretch along a seam in which every place has a differing pixel right before or right after it.
struct SeamRun {
    int from = 0, to = 0;  // along the line, half-open
    int length() const { return to - from; }
};

struct SeamErrors {
    Seam seam;
    long long differing_touching = 0;  // at distance 0, both sides
    long long differing_near = 0;      // at distances 0..SeamDistance::reach, this seam the nearest
    SeamRun longest_run;               // the first of the longest
    LineStep step;
};

// Pixels right before and right after the inner lines of the block grid.
struct BlockEdges {
    int block = 0;
    PixelCounts before;  // (x + 1 - region.x0) or (y + 1 - region.y0) a multiple of block
    PixelCounts after;   // (x - region.x0) or (y - region.y0) a multiple of block
};

struct SeamReport {
    struct Sides {
        GroupErrors before, after;
    };
    SeamLayout layout;
    std::array<Sides, SeamDistance::reach + 1> by_distance;
    GroupErrors interior;  // farther from every seam
    GroupErrors outside;   // of the rendered region
    std::vector<SectionErrors> sections;
    std::vector<SeamErrors> seams;
    std::vector<LineStep> controls;
    StepSummary seam_steps, control_steps;
    BlockEdges block_edges;
};

class SeamProfileBuilder {
  public:
    // Throws std::invalid_argument where the layout is of an image of another size.
    SeamProfileBuilder(SeamLayout layout, const ImageShape& shape);
    SeamProfileBuilder(const SeamProfileBuilder&) = delete;
    SeamProfileBuilder& operator=(const SeamProfileBuilder&) = delete;

    // Rows 0, 1, ... in order, each width x channels, interleaved.
    void add_row(int y, std::span<const double> a, std::span<const double> b);
    // Once, after the last row.
    SeamReport finish();

  private:
    void add_pixels(GroupErrors& group, std::span<const double> a, std::span<const double> b,
                    int x0, int x1);
    void add_sections(int y, std::span<const double> a, std::span<const double> b);
    void add_distances(int y, std::span<const double> a, std::span<const double> b);
    void add_runs(int y);
    void extend_run(std::size_t seam, int place, bool differs);
    void add_block_edges(int y);

    ImageShape shape_;
    SeamReport report_;
    SeamDistance distance_;
    std::vector<char> differs_, previous_;  // of this row and of the one above, per x
    std::vector<int> open_run_;             // per seam: where the run that is still open began, -1
    std::vector<StepBuilder> seam_steps_, control_steps_;
};

}  // namespace mpipov
