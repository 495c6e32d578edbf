// How unlikely every sample of an image is, given n equally right renders of the same scene. Pure:
// rows in, scores out.
//
//     z = |value - m| / sqrt((s^2 + q^2 / 12) f)
// m: mean of the renders at this sample; s^2: their variance there or, where that is larger, the
// mean variance of the 3 x 3 pixels around it (a variance from a dozen values is often far too
// small by chance, and antialiasing's rare flips sit beside noisy pixels); q: the step that values
// are rounded to, so that a sample that never changed still may by rounding; f = 1 + 1/n, because m
// is itself a mean of n (prediction of one new value).
// The renders are judged the same way, each against the others: the scores that equally right
// renders get are what the scores of an image have to be measured with.
#pragma once

#include "metrics.h"
#include "noise_floor.h"

#include <deque>
#include <functional>
#include <span>
#include <vector>

namespace mpipov {

struct ScoreRow {
    int y = 0;
    int render = -1;  // which of the renders was judged against the others; -1: the image
    // Width x channels each. z is NaN where one of the renders is not finite (nothing can be said),
    // infinite where only the judged sample is not.
    std::span<const double> z, value, expected;
    std::span<const double> sigma;  // the denominator of z
};

class PixelScores {
  public:
    enum class Judge { image, renders };
    using Sink = std::function<void(const ScoreRow&)>;

    // `spread`: variance of the image's error from m where there is no noise in m, in units of the
    // renders' variance: 1, or more where the image's values were combined of several.
    PixelScores(const ImageShape& shape, const Quantisation& quantisation, Judge judge, Sink sink,
                double spread = 1);
    // Rows 0, 1, ... in order, each width x channels; `image` empty for Judge::renders. Scores come
    // one row late.
    void add_row(int y, std::span<const std::span<const double>> renders,
                 std::span<const double> image);
    void finish();

  private:
    struct Judged {  // one of those that are judged, in one row
        std::vector<double> value, expected, variance;
    };
    struct Row {
        int y = 0;
        std::vector<Judged> judged;
    };
    void emit(std::size_t index);
    double factor(long long renders) const { return spread_ + 1 / static_cast<double>(renders); }

    ImageShape shape_;
    Quantisation quantisation_;
    Judge judge_;
    Sink sink_;
    double spread_;
    long long others_ = 0;  // how many renders one is judged against
    std::deque<Row> rows_;  // at most three
    std::vector<double> column_, z_, sigma_;
};

}  // namespace mpipov
