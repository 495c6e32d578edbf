#include "seam_judge.h"

#include "failure.h"
#include "image_stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace mpipov {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t fewest_renders = 4;

SeamLayout layout_of(const JudgeRequest& request, const ImageShape& shape) {
    try {
        SeamLayout layout = make_seam_layout(request.run);
        if (layout.width != shape.width || layout.height != shape.height)
            throw std::runtime_error(fmt::format("it is of {} x {} pixels, not {} x {}",
                                                 layout.width, layout.height, shape.width,
                                                 shape.height));
        return layout;
    } catch (const std::exception& error) {
        throw Failure(Exit::file, fmt::format("the run record does not fit '{}': {}",
                                              request.image.string(), error.what()));
    }
}

}  // namespace

SeamJudge::SeamJudge(std::vector<fs::path> renders) : renders_(std::move(renders)) {
    if (renders_.size() < fewest_renders)
        throw std::invalid_argument(
            fmt::format("noise cannot be judged from {} renders: {} are the fewest",
                        renders_.size(), fewest_renders));
}

void SeamJudge::calibrate(const Rect& region) {
    if (region_ && *region_ == region) return;
    ImageStack stack(renders_);
    calibration_.emplace(static_cast<int>(renders_.size()), region, stack.shape().channels);
    PixelScores scores(stack.shape(), quantisation_of(stack.format()), PixelScores::Judge::renders,
                       [&](const ScoreRow& row) { calibration_->add(row); });
    stack.for_each_row([&](int y, auto rows) { scores.add_row(y, rows, {}); });
    scores.finish();
    pixel_alarms_ = calibration_->alarms();
    region_ = region;
}

Judgement SeamJudge::judge(const JudgeRequest& request) {
    std::vector<fs::path> files = renders_;
    files.push_back(request.image);
    if (request.own_reference) files.push_back(*request.own_reference);
    ImageStack stack(files);
    const ImageShape shape = stack.shape();
    const Quantisation quantisation = quantisation_of(stack.format());
    const SeamLayout layout = layout_of(request, shape);
    calibrate(layout.region);

    const std::size_t n = renders_.size();
    const int combined = request.own_reference ? 3 : 1;
    PixelTestBuilder pixels(layout, *calibration_, shape.channels, combined);
    PixelScores scores(
        shape, quantisation, PixelScores::Judge::image,
        [&](const ScoreRow& row) { pixels.add(row); }, combined);
    StepTableBuilder steps(layout, shape, n + 1, quantisation.step(1, 1));
    std::vector<double> combination;
    std::vector<std::span<const double>> judged(n + 1);
    stack.for_each_row([&](int y, std::span<const std::span<const double>> rows) {
        std::copy_n(rows.begin(), n + 1, judged.begin());
        if (request.own_reference) {
            combination.resize(rows[n].size());
            for (std::size_t i = 0; i < combination.size(); ++i)
                combination[i] = rows[n][i] == rows[n + 1][i]
                                     ? rows[0][i]
                                     : rows[n][i] - rows[n + 1][i] + rows[0][i];
            judged[n] = combination;
        }
        scores.add_row(y, rows.first(n), judged[n]);
        steps.add_row(y, rows[0], judged);
    });
    scores.finish();

    Judgement judgement;
    judgement.pixel = pixels.result();
    StepTable table = steps.result();
    const std::vector<double> image_steps = std::move(table.steps.back());
    table.steps.pop_back();
    judgement.step = test_steps(table, image_steps, combined);
    const std::vector<bool> step = step_alarms(table);
    judgement.quiet.renders = static_cast<int>(n);
    for (std::size_t j = 0; j < n; ++j) {
        judgement.quiet.pixel_alarms += pixel_alarms_[j] ? 1 : 0;
        judgement.quiet.step_alarms += step[j] ? 1 : 0;
        judgement.quiet.alarms += pixel_alarms_[j] || step[j] ? 1 : 0;
    }
    return judgement;
}

NoiseFloor measure_noise(const std::vector<fs::path>& renders) {
    ImageStack stack(renders);
    NoiseFloorBuilder noise(stack.shape());
    stack.for_each_row([&](int y, auto rows) { noise.add_row(y, rows); });
    return noise.result();
}

}  // namespace mpipov
