// Cutting an image up: rectangles, partitions and the seams between their sections.
// Pure geometry: no I/O, no MPI, no clock. All coordinates are pixels, 0-based from the top left;
// rectangles are half-open, so that width is x1 - x0. (POV-Ray's own +SC/+EC are 1-based and
// inclusive; povray_command translates.)
#pragma once

#include <string_view>
#include <vector>

namespace mpipov {

struct Rect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    long long area() const { return empty() ? 0 : static_cast<long long>(width()) * height(); }
    bool empty() const { return x1 <= x0 || y1 <= y0; }
    bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
    bool operator==(const Rect&) const = default;
};

Rect intersect(const Rect& a, const Rect& b);

// `margin` more pixels on every side, but never past `bounds`.
Rect grow(const Rect& r, int margin, const Rect& bounds);

enum class Shape { columns, rows, tiles };

// Which serial render the sections are to reproduce, see docs/seams.md:
// aligned: section edges lie on POV-Ray's render-block grid, as the default serial render;
// halo: edges anywhere, rendered with an overlap, as a serial render in one block;
// plain: edges anywhere, no overlap, as MPIPOV 1999.
enum class Seams { aligned, halo, plain };

std::string_view to_string(Shape shape);
std::string_view to_string(Seams seams);

struct Section {
    int id = 0;
    Rect keep;    // the pixels of the result that this section owns; every pixel has one owner
    Rect render;  // what is rendered for it: keep, and with halo the overlap
    bool operator==(const Section&) const = default;
};

struct GridRequest {
    Rect region;  // the part of the image to render: all of it, or the user's +SC/+EC/+SR/+ER
    Shape shape = Shape::columns;
    Seams seams = Seams::aligned;
    int sections = 1;  // wanted; aligned grids may hold fewer
    int halo = 0;      // pixels of overlap on each inner side, with Seams::halo
    int block = 32;    // edge of POV-Ray's render blocks (+BS), with Seams::aligned
};

struct Partition {
    GridRequest request;
    std::vector<Section> sections;  // ids count from 0, in reading order of their top-left corners
    bool operator==(const Partition&) const;
};

// The largest number of sections that a grid of this shape and kind of seam can have.
long long max_sections(const GridRequest& request);

// Columns, as in the 1999 paper, while the grid has enough of them for its number of sections, then
// tiles. Whatever `request.shape` is.
Shape auto_shape(GridRequest request);

// Cuts the region up. Columns and rows as MPIPOV 1999 cut them: every strip has
// floor(size / sections) pixels (with aligned: grid cells) and the last one takes the rest up to W;
// but where the rest is more than an eighth of a strip (and more than one unit), it is spread, one
// unit each, over the last strips: one overlong strip would be all that static waits for.
// Throws std::invalid_argument where `sections` is < 1 or more than max_sections.
Partition make_partition(const GridRequest& request);

// The same with sections of any size: `keeps`, in any order, which must cover the region without
// overlap (not checked) and, with aligned seams, lie on its grid.
Partition partition_of(const GridRequest& request, std::vector<Rect> keeps);

// The line where two sections meet.
struct Seam {
    int a = 0, b = 0;  // section ids; a lies left of or above b
    bool vertical =
        false;         // true: a | b, the line x = position between columns position-1, position
    int position = 0;  // x (vertical) or y (horizontal) of b's first pixel
    int from = 0, to = 0;  // the extent along the line, half-open
    bool operator==(const Seam&) const = default;
};

std::vector<Seam> find_seams(const std::vector<Section>& sections);

}  // namespace mpipov
