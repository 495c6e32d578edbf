// The step of the signed error across a line: what the eye sees as a seam, where the mean error
// only says that the two images differ. At every place t along the line and for every channel,
//     step(t) = mean of the `window` pixels before the line - mean of those after it
// and for the line as a whole (error = b - a, in stored units)
//     mean step  = mean over colour channels of |mean over t of step(t)|
//     local step = mean over colour channels and t of |step(t)|.
// The first is the offset between two whole sections, in which noise along the line cancels; the
// second also sees steps that change sign along it, and has the noise in it: compare both with the
// control lines. Windows end at the sections' edges. Samples that are not finite are left out.
#pragma once

#include "metrics.h"
#include "seam_layout.h"

#include <optional>
#include <span>
#include <vector>

namespace mpipov {

struct LineStep {
    Seam line;
    std::vector<std::optional<double>> channels;  // signed mean over t of step(t), alpha included
    std::optional<double> mean_step, local_step;
};

// One line. Rows come in order; those that do not concern it are ignored.
class StepBuilder {
  public:
    static constexpr int window = 8;

    // `before` and `after`: the sections that end and begin at the line.
    StepBuilder(const Seam& line, const Rect& before, const Rect& after, const ImageShape& shape);
    void add_row(int y, std::span<const double> a, std::span<const double> b);
    LineStep result() const;

  private:
    struct Side {
        double sum = 0;
        int count = 0;
        void add(double error);
    };
    struct ChannelSums {
        Sum step, magnitude;
        long long places = 0;
    };
    void add_place(std::size_t channel, const Side& before, const Side& after);
    void add_across(std::span<const double> a, std::span<const double> b);
    void add_along(int y, std::span<const double> a, std::span<const double> b);

    Seam line_;
    int first_ = 0, last_ = 0;  // half-open range across the line that the windows cover
    ImageShape shape_;
    std::vector<ChannelSums> channels_;
    std::vector<Side> before_, after_;  // horizontal lines only: per place and channel, while open
};

// Means over lines, each weighted with its length.
struct StepSummary {
    int lines = 0;
    std::optional<double> mean_step, local_step;
};
StepSummary summarize(std::span<const LineStep> lines);

}  // namespace mpipov
