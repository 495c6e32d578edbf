// Where a run's seams lie, and how far a pixel is from the nearest one. Pure geometry.
#pragma once

#include "run_record.h"
#include "section.h"

#include <span>
#include <vector>

namespace mpipov {

struct SeamLayout {
    int width = 0, height = 0;  // of the whole image
    Rect region;                // the part of it that was rendered
    int block = 32;             // edge of the serial render's blocks, counted from region's corner
    std::vector<Section> sections;  // by id
    std::vector<Seam> seams;
    // Lines that are no seams, to compare seams with: through the middle of every section that is
    // wide enough, in the direction of its seams. `a` and `b` are both that section.
    std::vector<Seam> controls;

    const Section& section(int id) const;  // throws std::out_of_range
};

// Throws std::runtime_error where the record cannot be of a finished render: `complete` is false,
// the sections do not tile the region, or the region leaves the image.
SeamLayout make_seam_layout(const RunRecord& record);

// Distance counts pixels from a seam, the same on both sides: for the line x = position, the pixel
// x = position is at 0 after it and x = position - 1 is at 0 before it ("before": left or above).
// Past the ends of a seam the larger of the distances across and along it counts.
struct NearSeam {
    int seam = -1;  // index into SeamLayout::seams; -1: farther than `reach` from every seam
    int distance = 0;
    bool before = false;
};

class SeamDistance {
  public:
    static constexpr int reach = 31;  // the largest distance told apart

    explicit SeamDistance(const SeamLayout& layout) : layout_(&layout) {}
    // One entry for every x of row y; valid until the next call. The nearest seam wins, the first
    // of SeamLayout::seams where several are equally near.
    std::span<const NearSeam> row(int y);

  private:
    void mark(int seam, int x, int distance, bool before);

    const SeamLayout* layout_;  // outlives this
    std::vector<NearSeam> row_;
};

}  // namespace mpipov
