#include "cost_map.h"

#include "json_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace mpipov {
namespace {

// More corners than any grid of sections has; a map that needs more is not one of rectangles.
constexpr std::size_t most_corners = std::size_t{1} << 24;

void sort_once(std::vector<int>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::size_t index_of(const std::vector<int>& values, int value) {
    return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) -
                                    values.begin());
}

std::string name_of(const Rect& r) {
    return fmt::format("the rectangle {},{} to {},{}", r.x0, r.y0, r.x1, r.y1);
}

// Which cell of `values` holds x, and how far into it x lies (0 to 1).
std::pair<std::size_t, double> place_in(const std::vector<int>& values, double x) {
    const auto next = std::upper_bound(values.begin(), values.end(), x);
    if (next == values.end()) return {values.size() - 1, 0};
    const double from = *std::prev(next);
    return {static_cast<std::size_t>(next - values.begin()) - 1, (x - from) / (*next - from)};
}

}  // namespace

CostMap::CostMap(const Rect& region, std::vector<CostPatch> patches)
    : region_(region), patches_(std::move(patches)) {
    if (region.empty()) throw std::invalid_argument("a cost map has at least one pixel");
    xs_ = {region.x0, region.x1};
    ys_ = {region.y0, region.y1};
    for (const auto& [rect, seconds] : patches_) {
        if (rect.empty() || intersect(rect, region) != rect)
            throw std::invalid_argument(name_of(rect) + " is empty or not within the image");
        if (!std::isfinite(seconds) || seconds < 0)
            throw std::invalid_argument(name_of(rect) + " costs less than nothing");
        xs_.insert(xs_.end(), {rect.x0, rect.x1});
        ys_.insert(ys_.end(), {rect.y0, rect.y1});
    }
    sort_once(xs_);
    sort_once(ys_);
    const std::size_t columns = xs_.size(), rows = ys_.size();
    if (columns > most_corners / rows)
        throw std::invalid_argument("the rectangles have too many different edges");
    corner_costs_.assign(columns * rows, 0);
    std::vector<char> taken(columns * rows, 0);
    // First the cost of the cell that ends at each corner, then the sums.
    for (const auto& [rect, seconds] : patches_)
        for (std::size_t j = index_of(ys_, rect.y0); ys_[j] < rect.y1; ++j)
            for (std::size_t i = index_of(xs_, rect.x0); xs_[i] < rect.x1; ++i) {
                const std::size_t corner = (j + 1) * columns + i + 1;
                if (std::exchange(taken[corner], 1) != 0)
                    throw std::invalid_argument(name_of(rect) + " overlaps another one");
                const double area =
                    static_cast<double>(xs_[i + 1] - xs_[i]) * (ys_[j + 1] - ys_[j]);
                corner_costs_[corner] = seconds * area / static_cast<double>(rect.area());
            }
    for (std::size_t j = 1; j < rows; ++j) {
        double row = 0;
        for (std::size_t i = 1; i < columns; ++i) {
            row += corner_costs_[j * columns + i];
            corner_costs_[j * columns + i] = row + corner_costs_[(j - 1) * columns + i];
        }
    }
}

// The integral from the top left corner; bilinear within a cell, because the density is constant.
double CostMap::up_to(double x, double y) const {
    const auto [i, u] = place_in(xs_, x);
    const auto [j, v] = place_in(ys_, y);
    const auto corner = [&](std::size_t column, std::size_t row) {
        return corner_costs_[std::min(row, ys_.size() - 1) * xs_.size() +
                             std::min(column, xs_.size() - 1)];
    };
    return (1 - v) * ((1 - u) * corner(i, j) + u * corner(i + 1, j)) +
           v * ((1 - u) * corner(i, j + 1) + u * corner(i + 1, j + 1));
}

double CostMap::cpu_seconds(const Rect& wanted) const {
    const Rect r = intersect(wanted, region_);
    if (r.empty()) return 0;
    const double cost =
        up_to(r.x1, r.y1) - up_to(r.x0, r.y1) - up_to(r.x1, r.y0) + up_to(r.x0, r.y0);
    return std::max(0.0, cost);  // never less than nothing for rounding
}

CostMap uniform_costs(const Rect& region, double cpu_seconds) {
    return {region, {{region, cpu_seconds}}};
}

CostMap hill_costs(const Rect& region, double cpu_seconds) {
    constexpr int cells = 32;
    const int across = std::min(cells, region.width()), down = std::min(cells, region.height());
    std::vector<CostPatch> patches;
    double sum = 0;
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i) {
            const auto x_of = [&](long long n) {
                return region.x0 + static_cast<int>(region.width() * n / across);
            };
            const auto y_of = [&](long long n) {
                return region.y0 + static_cast<int>(region.height() * n / down);
            };
            const Rect rect{x_of(i), y_of(j), x_of(i + 1), y_of(j + 1)};
            const double x = (i + 0.5) / across - 0.5, y = (j + 0.5) / down - 0.6;
            const double density = 1 + 9 * std::exp(-(x * x + y * y) / (2 * 0.2 * 0.2));
            patches.push_back({rect, density * static_cast<double>(rect.area())});
            sum += patches.back().cpu_seconds;
        }
    for (CostPatch& patch : patches) patch.cpu_seconds *= cpu_seconds / sum;
    return {region, std::move(patches)};
}

CostMap stretched(const CostMap& costs, const Rect& region) {
    const Rect& from = costs.region();
    const auto along = [](int at, int a0, int a1, int b0, int b1) {
        return b0 +
               static_cast<int>(std::llround(static_cast<double>(at - a0) * (b1 - b0) / (a1 - a0)));
    };
    const double more = static_cast<double>(region.area()) / static_cast<double>(from.area());
    std::vector<CostPatch> patches;
    for (const auto& [r, seconds] : costs.patches()) {
        const Rect to{along(r.x0, from.x0, from.x1, region.x0, region.x1),
                      along(r.y0, from.y0, from.y1, region.y0, region.y1),
                      along(r.x1, from.x0, from.x1, region.x0, region.x1),
                      along(r.y1, from.y0, from.y1, region.y0, region.y1)};
        if (!to.empty()) patches.push_back({to, seconds * more});
    }
    return {region, std::move(patches)};
}

CostMap with_sum(const CostMap& costs, double cpu_seconds) {
    const double sum = costs.cpu_seconds();
    if (!(sum > 0)) throw std::invalid_argument("nothing in the cost map costs anything");
    if (!std::isfinite(sum)) throw std::invalid_argument("the cost map's sum is no number");
    std::vector<CostPatch> patches = costs.patches();
    // In this order, because 1 / sum may be beyond a double.
    for (CostPatch& patch : patches) patch.cpu_seconds = patch.cpu_seconds / sum * cpu_seconds;
    return {costs.region(), std::move(patches)};
}

CostMap costs_of_run(const RunRecord& record, double per_launch) {
    if (record.sections.empty()) throw std::invalid_argument("the record has no sections");
    std::vector<CostPatch> patches;
    for (const SectionRecord& section : record.sections)
        patches.push_back({section.section.keep, std::max(0.0, section.cpu_seconds - per_launch)});
    return {record.plan.region, std::move(patches)};
}

CostMap cost_map_from_json(const nlohmann::json& json) {
    try {
        if (member(json, "format") != "mpipov-costs" || member(json, "version") != 1)
            throw std::runtime_error("not a cost map (\"format\": \"mpipov-costs\", version 1)");
        std::vector<CostPatch> patches;
        for (const nlohmann::json& one : member(json, "rectangles"))
            patches.push_back({{member<int>(one, "x0"), member<int>(one, "y0"),
                                member<int>(one, "x1"), member<int>(one, "y1")},
                               member<double>(one, "cpu_seconds")});
        return {{0, 0, member<int>(json, "width"), member<int>(json, "height")},
                std::move(patches)};
    } catch (const std::invalid_argument& error) {
        throw std::runtime_error(error.what());
    }
}

CostMap read_cost_map(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(fmt::format("cannot read '{}'", file.string()));
    try {
        return cost_map_from_json(parse_json(in));
    } catch (const std::exception& error) {
        throw std::runtime_error(fmt::format("cannot read '{}': {}", file.string(), error.what()));
    }
}

}  // namespace mpipov
