// Does the signed error step at the seams as it would not in an equally right render? Pure.
//
// Of every image the signed mean step at every line and channel is known (seam_step.h). At a seam
//     z = |step - m| / sqrt((s^2 + floor) (1 + 1/n))
// with m and s^2 of the n renders' steps at the same line, and the floor that rounding of the
// pixels leaves in a mean over so many of them: q^2 / 12 * 2 / window / length. That finds one bad
// seam. A step that noise hides at every single line may yet show in all of them together, so a
// second score sums up the seams: A = mean over seams and channels of |step - m|, weighted with
// length; z = (log A - mean of the renders' log A) / (their deviation * sqrt(1 + 1/n)), where each
// render's A is taken against the other renders; one-sided: a smaller step than noise is no seam.
// Each score gets half of alpha, the first corrected (Sidak) for the number of seams and channels.
// Critical values are Student's, or those that follow from the renders' own scores, at seams and
// at control lines, where these are more.
// A step that is everywhere (at the control lines too) is told by controls_beyond.
#pragma once

#include "noise_floor.h"
#include "pixel_check.h"
#include "seam_layout.h"
#include "seam_step.h"

#include <optional>
#include <span>
#include <vector>

namespace mpipov {

// The signed steps of several images at the same lines.
struct StepTable {
    struct Column {  // a line in one colour channel
        Seam line;
        int seam = -1;  // index into SeamLayout::seams, -1: a control line
        int channel = 0;
        double floor = 0;   // variance that rounding leaves in the step
        double weight = 0;  // the line's length
    };
    std::vector<Column> columns;
    std::vector<std::vector<double>> steps;  // [image][column]; NaN where there is none
};

class StepTableBuilder {
  public:
    // `rounding_step`: what the pixels are rounded to, in stored units.
    StepTableBuilder(const SeamLayout& layout, const ImageShape& shape, std::size_t images,
                     double rounding_step);
    // Row y of the reference and of each image, width x channels each.
    void add_row(int y, std::span<const double> reference,
                 std::span<const std::span<const double>> images);
    StepTable result() const;

  private:
    SeamLayout layout_;
    ImageShape shape_;
    double rounding_step_;
    std::vector<std::vector<StepBuilder>> builders_;  // [image][line]: seams, then controls
};

struct StepTest {
    double alpha = significance, alpha_sidak = 0;  // of one line and channel
    int renders = 0, tests = 0;
    double critical = 0;
    std::optional<double> largest;  // score at a seam
    std::optional<StepTable::Column> at;
    double step = 0, expected = 0;  // there
    int beyond = 0, controls_beyond = 0;
    // The power of the test: a step this far from what is expected would be found at half of the
    // seams and channels (their median), in stored units.
    double detectable = 0;

    struct Together {
        double mean = 0;      // A
        double expected = 0;  // exp of the mean log A of the renders
        double z = 0, critical = 0;
        bool beyond() const { return z > critical; }
    };
    std::optional<Together> together;  // none where there is no seam

    bool alarm() const { return beyond > 0 || (together && together->beyond()); }
};

// `judged`: the image's steps at the columns of `renders`. `spread` as in pixel_scores.h.
StepTest test_steps(const StepTable& renders, std::span<const double> judged, double spread = 1);

// For each render whether it would raise an alarm, judged by what the others say.
std::vector<bool> step_alarms(const StepTable& renders);

}  // namespace mpipov
