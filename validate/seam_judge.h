// Judges images that were rendered in sections against equally right serial renders of the scene:
// pixel by pixel (pixel_check.h) and by the step at the seams (step_check.h).
#pragma once

#include "noise_floor.h"
#include "pixel_check.h"
#include "run_record.h"
#include "step_check.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace mpipov {

// How the equally right renders fare when each is judged against the others, at the same seams:
// about alpha of them should raise an alarm in each test.
struct QuietRate {
    int renders = 0;
    int pixel_alarms = 0, step_alarms = 0, alarms = 0;  // alarms: in either
};

struct Judgement {
    PixelTest pixel;
    StepTest step;
    QuietRate quiet;
    bool alarm() const { return pixel.alarm() || step.alarm(); }
};

struct JudgeRequest {
    std::filesystem::path image;
    RunRecord run;  // of the image
    // The serial render that the image is to reproduce, where it is not one of the renders and its
    // pixels are expected to differ from theirs by more than noise (antialiasing in one block
    // instead of many). Then image - own reference + first render is judged: the three noises add
    // up, f of pixel_scores.h is 3 + 1/n, and the tails of three are allowed for.
    std::optional<std::filesystem::path> own_reference;
};

class SeamJudge {
  public:
    // At least 4 renders, the serial reference first. Throws std::invalid_argument.
    explicit SeamJudge(std::vector<std::filesystem::path> renders);

    // Reads every file once, twice for the first judgement and wherever the rendered region is
    // another. Memory: a few rows of all images. Throws Failure(Exit::file): unreadable, or the
    // images or the record do not fit each other; Failure(Exit::interrupted).
    Judgement judge(const JudgeRequest& request);

  private:
    void calibrate(const Rect& region);

    std::vector<std::filesystem::path> renders_;
    std::optional<Rect> region_;  // of the calibration
    std::optional<PixelCalibration> calibration_;
    std::vector<bool> pixel_alarms_;
};

// The noise floor of the renders. Throws as SeamJudge::judge.
NoiseFloor measure_noise(const std::vector<std::filesystem::path>& renders);

}  // namespace mpipov
