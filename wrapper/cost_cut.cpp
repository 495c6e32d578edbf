#include "cost_cut.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

namespace mpipov {
namespace {

constexpr double first_share = 3, last_share = 12;  // of a lane's share of the work
constexpr double shrinking_part = 0.25;             // of the work
// Edges of plain and halo sections may lie anywhere, but strips of a few pixels help nobody.
constexpr int least_side = 16;

struct Piece {
    Rect rect;
    double cost = 0;
    bool operator<(const Piece& other) const { return cost < other.cost; }
};

class Cutter {
  public:
    Cutter(const GridRequest& grid, const CostMap& costs, double least)
        : grid_(grid), costs_(costs), least_(least) {}

    Piece piece(const Rect& rect) const { return {rect, costs_.cpu_seconds(rect)}; }

    // In two of nearly the same cost, across its longer side or, where that is one unit, the other.
    std::optional<std::pair<Piece, Piece>> halve(const Piece& whole) const {
        if (whole.cost < 2 * least_) return {};
        const bool wide = whole.rect.width() >= whole.rect.height();
        for (const bool across : {wide, !wide})
            if (auto halves = halve(whole, across)) return halves;
        return {};
    }

  private:
    long long unit() const { return grid_.seams == Seams::aligned ? grid_.block : least_side; }

    std::optional<std::pair<Piece, Piece>> halve(const Piece& whole, bool across) const {
        const Rect& r = whole.rect;
        const int from = across ? r.x0 : r.y0, to = across ? r.x1 : r.y1;
        const int origin = across ? grid_.region.x0 : grid_.region.y0;
        std::optional<std::pair<Piece, Piece>> best;
        // The grid begins where the region does: r's own edges lie on it.
        for (long long next = origin + ((from - origin) / unit() + 1) * unit(); next < to;
             next += unit()) {
            const int at = static_cast<int>(next);
            Rect a = r, b = r;
            (across ? a.x1 : a.y1) = at;
            (across ? b.x0 : b.y0) = at;
            const std::pair halves{piece(a), piece(b)};
            const auto gap = [](const auto& h) { return std::abs(h.first.cost - h.second.cost); };
            if (!best || gap(halves) < gap(*best)) best = halves;
        }
        return best;
    }

    const GridRequest& grid_;
    const CostMap& costs_;
    double least_;
};

}  // namespace

Partition cut_by_cost(const GridRequest& grid, const CostMap& costs, const CutByCost& wanted) {
    const Cutter cutter(grid, costs, wanted.least);
    const double share = costs.cpu_seconds(grid.region) / wanted.lanes;
    std::priority_queue<Piece> large;
    std::vector<Piece> pieces;
    large.push(cutter.piece(grid.region));
    while (!large.empty()) {
        const Piece piece = large.top();
        large.pop();
        const auto halves = piece.cost > share / first_share ? cutter.halve(piece) : std::nullopt;
        if (!halves) {
            pieces.push_back(piece);
            continue;
        }
        large.push(halves->first);
        large.push(halves->second);
    }
    // The smallest ones come last anyway: they are the part that shrinks.
    std::sort(pieces.begin(), pieces.end());
    std::vector<Rect> keeps;
    std::vector<Piece> shrinking;
    double shrinking_cost = 0;
    for (const Piece& piece : pieces) {
        if (shrinking_cost < shrinking_part * share * wanted.lanes && wanted.lanes > 1) {
            shrinking_cost += piece.cost;
            shrinking.push_back(piece);
        } else {
            keeps.push_back(piece.rect);
        }
    }
    while (!shrinking.empty()) {
        const Piece piece = shrinking.back();
        shrinking.pop_back();
        const auto halves = piece.cost > share / last_share ? cutter.halve(piece) : std::nullopt;
        if (!halves) {
            keeps.push_back(piece.rect);
            continue;
        }
        shrinking.push_back(halves->first);
        shrinking.push_back(halves->second);
    }
    GridRequest tiles = grid;
    tiles.shape = Shape::tiles;
    return partition_of(tiles, std::move(keeps));
}

}  // namespace mpipov
