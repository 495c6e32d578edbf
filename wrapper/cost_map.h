// What tracing costs where in an image: CPU seconds, spread evenly within rectangles. Pure, but for
// read_cost_map.
#pragma once

#include "run_record.h"
#include "section.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <vector>

namespace mpipov {

struct CostPatch {
    Rect rect;
    double cpu_seconds = 0;
};

class CostMap {
  public:
    // The rectangles lie in `region` and do not overlap; what none covers costs nothing. Throws
    // std::invalid_argument otherwise, and for costs that are negative or no number.
    CostMap(const Rect& region, std::vector<CostPatch> patches);

    const Rect& region() const { return region_; }
    const std::vector<CostPatch>& patches() const { return patches_; }
    // Within 1e-15 of what all costs, for each corner of a rectangle that it is summed from: beside
    // parts that cost 1e15 times as much, what a part costs is not told from nothing.
    double cpu_seconds(const Rect& rect) const;
    double cpu_seconds() const { return cpu_seconds(region_); }

  private:
    double up_to(double x, double y) const;

    Rect region_;
    std::vector<CostPatch> patches_;
    std::vector<int> xs_, ys_;          // where rectangles begin or end
    std::vector<double> corner_costs_;  // of all above and left of (xs_[i], ys_[j]), row by row
};

// One rectangle.
CostMap uniform_costs(const Rect& region, double cpu_seconds);
// A made-up scene: most of the work in a round hill somewhat below the middle, in whose middle a
// pixel costs ten times what it does far away.
CostMap hill_costs(const Rect& region, double cpu_seconds);

// The same for another size or part of the same picture.
CostMap stretched(const CostMap& costs, const Rect& region);

// The same with another sum. Throws std::invalid_argument where nothing in it costs anything, and
// where all together is beyond a double.
CostMap with_sum(const CostMap& costs, double cpu_seconds);

// Of a finished run's sections, without `per_launch` CPU seconds of each. Throws
// std::invalid_argument where the record has no sections.
CostMap costs_of_run(const RunRecord& record, double per_launch);

// {"format": "mpipov-costs", "version": 1, "width": W, "height": H,
//  "rectangles": [{"x0", "y0", "x1", "y1", "cpu_seconds"}, ...]}
// Throws std::runtime_error, naming what is wrong.
CostMap cost_map_from_json(const nlohmann::json& json);
CostMap read_cost_map(const std::filesystem::path& file);

}  // namespace mpipov
