// Is there a sample in this image that an equally right render would not have? Pure.
//
// Every sample of the rendered region is tested (pixel_scores.h says how it is scored), with the
// significance alpha over all of them (Sidak). The critical score is Student's, with one degree of
// freedom less than there are renders, or what the renders' own scores say where that is more:
// jitter and antialiasing have heavy tails (significance.h, critical_value).
#pragma once

#include "pixel_scores.h"
#include "seam_layout.h"
#include "significance.h"

#include <map>
#include <optional>
#include <vector>

namespace mpipov {

inline constexpr double significance = 0.01;

// The scores that the renders get from each other.
class PixelCalibration {
  public:
    // `region`: what was rendered; the rest of the image is not looked at.
    PixelCalibration(int renders, const Rect& region, int channels);
    void add(const ScoreRow& row);  // of PixelScores::Judge::renders

    int renders() const { return static_cast<int>(tails_.size()); }
    long long samples() const;  // tested in one image
    // For an image. `combined`: of how many images its values are made, each with tails of its own.
    double critical(int combined = 1) const;
    // For each render whether it would raise an alarm, judged by what the others say.
    std::vector<bool> alarms() const;

  private:
    Rect region_;
    std::size_t channels_;
    std::vector<TailSample> tails_;  // of each render
};

struct PixelOutlier {
    int x = 0, y = 0, channel = 0;
    double value = 0, expected = 0, sigma = 0;
    int seam_distance = -1;  // -1: farther than SeamDistance::reach from every seam
};

struct PixelTest {
    static constexpr int near = 7;  // distances 0..7 are near a seam: a step's window

    double alpha = significance, alpha_sidak = 0;
    long long samples = 0;
    int renders = 0;
    double critical = 0;
    std::optional<double> largest;   // score; infinite where a sample is not finite
    std::optional<PixelOutlier> at;  // the largest score
    long long beyond = 0;            // samples
    long long beyond_near = 0;       // of these: at most `near` from a seam
    Rect beyond_box;                 // empty where there are none
    std::map<int, long long> beyond_by_section;

    bool alarm() const { return beyond > 0; }
};

class PixelTestBuilder {
  public:
    PixelTestBuilder(const SeamLayout& layout, const PixelCalibration& calibration, int channels,
                     int combined = 1);
    PixelTestBuilder(const PixelTestBuilder&) = delete;
    PixelTestBuilder& operator=(const PixelTestBuilder&) = delete;
    void add(const ScoreRow& row);  // of PixelScores::Judge::image
    const PixelTest& result() const { return test_; }

  private:
    void add_beyond(int x, int y, int distance);

    const SeamLayout* layout_;  // outlives this
    SeamDistance distance_;
    std::size_t channels_;
    PixelTest test_;
};

}  // namespace mpipov
