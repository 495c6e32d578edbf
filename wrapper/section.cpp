#include "section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace mpipov {
namespace {

// A length that is cut in units: grid cells of `unit` pixels with aligned seams, else single
// pixels.
struct Axis {
    int begin = 0, end = 0;
    long long unit = 1;  // a render block may be larger than any image

    int units() const { return static_cast<int>((end - begin + unit - 1) / unit); }
    int pixel(int units_from_begin) const {
        return static_cast<int>(std::min<long long>(end, begin + units_from_begin * unit));
    }
};

Axis horizontal_axis(const GridRequest& request) {
    return {request.region.x0, request.region.x1,
            request.seams == Seams::aligned ? request.block : 1};
}

Axis vertical_axis(const GridRequest& request) {
    return {request.region.y0, request.region.y1,
            request.seams == Seams::aligned ? request.block : 1};
}

// The n+1 edges of n strips, in units.
std::vector<int> cut(int units, int n) {
    const int strip = units / n;
    const int rest = units % n;
    const bool last_takes_rest = rest <= std::max(1, strip / 8);
    std::vector<int> edges{0};
    for (int i = 0; i < n; ++i) {
        int size = strip;
        if (last_takes_rest) {
            if (i == n - 1) size += rest;
        } else if (i >= n - rest) {
            ++size;
        }
        edges.push_back(edges.back() + size);
    }
    return edges;
}

// Cuts `units` so that part i gets a share in proportion to its weight, and at least one unit.
std::vector<int> cut_by_weight(int units, const std::vector<int>& weights) {
    long long total = 0;
    for (int w : weights) total += w;
    std::vector<int> edges{0};
    long long before = 0;
    const int n = static_cast<int>(weights.size());
    for (int i = 0; i < n; ++i) {
        before += weights[i];
        const auto ideal = static_cast<int>(std::llround(
            static_cast<double>(units) * static_cast<double>(before) / static_cast<double>(total)));
        const int least = edges.back() + 1;
        const int most = units - (n - 1 - i);
        edges.push_back(std::clamp(ideal, least, most));
    }
    return edges;
}

// Rows of tiles: as square as the grid allows, and exactly as many tiles as were asked for, so rows
// may differ by one tile and their heights follow their number of tiles.
std::vector<Rect> cut_tiles(const GridRequest& request) {
    const Axis across = horizontal_axis(request);
    const Axis down = vertical_axis(request);
    const int wanted = request.sections;
    const double aspect =
        static_cast<double>(request.region.height()) / static_cast<double>(request.region.width());
    const int fewest_rows = (wanted - 1) / across.units() + 1;
    const int most_rows = std::min(down.units(), wanted);
    const int rows = std::clamp(static_cast<int>(std::lround(std::sqrt(wanted * aspect))),
                                fewest_rows, most_rows);
    std::vector<int> tiles_in_row;
    for (int r = 0; r < rows; ++r)
        tiles_in_row.push_back(wanted / rows + (r < wanted % rows ? 1 : 0));
    const std::vector<int> y = cut_by_weight(down.units(), tiles_in_row);
    std::vector<Rect> rects;
    for (int r = 0; r < rows; ++r) {
        const std::vector<int> x = cut(across.units(), tiles_in_row[r]);
        for (int c = 0; c < tiles_in_row[r]; ++c)
            rects.push_back({across.pixel(x[c]), down.pixel(y[r]), across.pixel(x[c + 1]),
                             down.pixel(y[r + 1])});
    }
    return rects;
}

std::vector<Rect> cut_rects(const GridRequest& request) {
    const Rect& region = request.region;
    if (request.shape == Shape::tiles) return cut_tiles(request);
    const bool columns = request.shape == Shape::columns;
    const Axis axis = columns ? horizontal_axis(request) : vertical_axis(request);
    const std::vector<int> edges = cut(axis.units(), request.sections);
    std::vector<Rect> rects;
    for (int i = 0; i < request.sections; ++i) {
        const int from = axis.pixel(edges[i]);
        const int to = axis.pixel(edges[i + 1]);
        rects.push_back(columns ? Rect{from, region.y0, to, region.y1}
                                : Rect{region.x0, from, region.x1, to});
    }
    return rects;
}

Partition number_sections(const GridRequest& request, const std::vector<Rect>& keeps) {
    Partition partition{request, {}};
    const int halo = request.seams == Seams::halo ? request.halo : 0;
    for (const Rect& keep : keeps)
        partition.sections.push_back(
            {static_cast<int>(partition.sections.size()), keep, grow(keep, halo, request.region)});
    return partition;
}

}  // namespace

Rect intersect(const Rect& a, const Rect& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

Rect grow(const Rect& r, int margin, const Rect& bounds) {
    // A margin may be larger than any image.
    const auto down = [margin](int at, int least) {
        return static_cast<int>(std::max<long long>(least, static_cast<long long>(at) - margin));
    };
    const auto up = [margin](int at, int most) {
        return static_cast<int>(std::min<long long>(most, static_cast<long long>(at) + margin));
    };
    return {down(r.x0, bounds.x0), down(r.y0, bounds.y0), up(r.x1, bounds.x1), up(r.y1, bounds.y1)};
}

std::string_view to_string(Shape shape) {
    switch (shape) {
        case Shape::columns:
            return "columns";
        case Shape::rows:
            return "rows";
        case Shape::tiles:
            return "tiles";
    }
    return "?";
}

std::string_view to_string(Seams seams) {
    switch (seams) {
        case Seams::aligned:
            return "aligned";
        case Seams::halo:
            return "halo";
        case Seams::plain:
            return "plain";
    }
    return "?";
}

bool Partition::operator==(const Partition& other) const {
    return sections == other.sections;
}

long long max_sections(const GridRequest& request) {
    const long long across = horizontal_axis(request).units();
    const long long down = vertical_axis(request).units();
    switch (request.shape) {
        case Shape::columns:
            return across;
        case Shape::rows:
            return down;
        case Shape::tiles:
            return across * down;
    }
    return 0;
}

Shape auto_shape(GridRequest request) {
    request.shape = Shape::columns;
    return request.sections <= max_sections(request) ? Shape::columns : Shape::tiles;
}

Partition make_partition(const GridRequest& request) {
    if (request.region.empty()) throw std::invalid_argument("the region to render is empty");
    if (request.block < 1) throw std::invalid_argument("a render block has at least one pixel");
    if (request.halo < 0) throw std::invalid_argument("a halo cannot be negative");
    const long long most = max_sections(request);
    if (request.sections < 1 || request.sections > most)
        throw std::invalid_argument(
            fmt::format("cannot cut {} x {} pixels into {} {} with {} seams: 1 to {} are possible",
                        request.region.width(), request.region.height(), request.sections,
                        to_string(request.shape), to_string(request.seams), most));
    return number_sections(request, cut_rects(request));
}

Partition partition_of(const GridRequest& request, std::vector<Rect> keeps) {
    std::sort(keeps.begin(), keeps.end(), [](const Rect& a, const Rect& b) {
        return std::pair(a.y0, a.x0) < std::pair(b.y0, b.x0);
    });
    GridRequest of_these = request;
    of_these.sections = static_cast<int>(keeps.size());
    return number_sections(of_these, keeps);
}

std::vector<Seam> find_seams(const std::vector<Section>& sections) {
    // By edge position, so that ten thousand sections do not need every pair looked at.
    std::map<int, std::vector<const Section*>> begins_at_x, begins_at_y;
    for (const Section& s : sections) {
        begins_at_x[s.keep.x0].push_back(&s);
        begins_at_y[s.keep.y0].push_back(&s);
    }
    std::vector<Seam> seams;
    for (const Section& a : sections) {
        if (const auto found = begins_at_x.find(a.keep.x1); found != begins_at_x.end())
            for (const Section* b : found->second) {
                const int from = std::max(a.keep.y0, b->keep.y0);
                const int to = std::min(a.keep.y1, b->keep.y1);
                if (from < to) seams.push_back({a.id, b->id, true, a.keep.x1, from, to});
            }
        if (const auto found = begins_at_y.find(a.keep.y1); found != begins_at_y.end())
            for (const Section* b : found->second) {
                const int from = std::max(a.keep.x0, b->keep.x0);
                const int to = std::min(a.keep.x1, b->keep.x1);
                if (from < to) seams.push_back({a.id, b->id, false, a.keep.y1, from, to});
            }
    }
    return seams;
}

}  // namespace mpipov
