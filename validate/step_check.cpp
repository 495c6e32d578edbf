#include "step_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpipov {
namespace {

constexpr double smallest_deviation_of_log = 0.1;  // of A: 10 %, less is luck with few renders

using Steps = std::vector<std::vector<double>>;

struct Scores {
    std::vector<double> expected, sigma, z;  // per column; z NaN: cannot be judged
    double log_mean = 0;                     // log A over the seams
    bool seams = false;
};

Scores score(const StepTable& table, const Steps& renders, std::span<const double> judged,
             double spread) {
    Scores scores;
    const auto n = static_cast<double>(renders.size());
    const double factor = spread + 1 / n;
    double sum = 0, weights = 0, floors = 0;
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
        Welford over;
        for (const auto& render : renders) over.add(render[k]);
        const StepTable::Column& column = table.columns[k];
        const double off = std::abs(judged[k] - over.mean());
        scores.expected.push_back(over.mean());
        scores.sigma.push_back(std::sqrt((over.variance() + column.floor) * factor));
        scores.z.push_back(off / scores.sigma.back());
        if (column.seam < 0 || !std::isfinite(scores.z.back())) continue;
        // A of a combined image, of more noise, is brought to the scale of one render's.
        sum += column.weight * off * std::sqrt((1 + 1 / n) / factor);
        floors += column.weight * std::sqrt(column.floor);
        weights += column.weight;
    }
    if (weights > 0) {
        scores.log_mean = std::log((sum + floors) / weights);
        scores.seams = true;
    }
    return scores;
}

Steps without(const Steps& renders, std::size_t j) {
    Steps rest = renders;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(j));
    return rest;
}

// The scores of each of the renders against the others.
std::vector<Scores> scores_of_each(const StepTable& table, const Steps& renders) {
    std::vector<Scores> scores;
    for (std::size_t j = 0; j < renders.size(); ++j)
        scores.push_back(score(table, without(renders, j), renders[j], 1));
    return scores;
}

StepTest judge(const StepTable& table, const Scores& judged, const std::vector<Scores>& quiet,
               int renders) {
    StepTest test;
    test.renders = renders;
    std::vector<double> sigmas;
    for (std::size_t k = 0; k < table.columns.size(); ++k)
        if (table.columns[k].seam >= 0 && !std::isnan(judged.z[k]))
            sigmas.push_back(judged.sigma[k]);
    if (sigmas.empty()) return test;
    test.tests = static_cast<int>(sigmas.size());

    TailSample tail;
    for (const Scores& scores : quiet)
        for (const double z : scores.z)
            if (!std::isnan(z)) tail.add(z);
    test.alpha_sidak = sidak(test.alpha / 2, test.tests);
    test.critical =
        critical_value(tail, test.alpha_sidak, t_quantile(test.alpha_sidak / 2, renders - 1));
    const auto middle = sigmas.begin() + test.tests / 2;
    std::nth_element(sigmas.begin(), middle, sigmas.end());
    test.detectable = test.critical * *middle;
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
        const double z = judged.z[k];
        if (std::isnan(z)) continue;
        const bool seam = table.columns[k].seam >= 0;
        if (z > test.critical) ++(seam ? test.beyond : test.controls_beyond);
        if (!seam || (test.largest && z <= *test.largest)) continue;
        test.largest = z;
        test.at = table.columns[k];
        test.expected = judged.expected[k];
    }
    Welford logs;
    for (const Scores& scores : quiet)
        if (scores.seams) logs.add(scores.log_mean);
    if (judged.seams && logs.count() >= 2) {
        const auto n = static_cast<double>(logs.count());
        const double deviation = std::max(std::sqrt(logs.variance()), smallest_deviation_of_log);
        test.together = {std::exp(judged.log_mean), std::exp(logs.mean()),
                         (judged.log_mean - logs.mean()) / (deviation * std::sqrt(1 + 1 / n)),
                         t_quantile(test.alpha / 2, static_cast<int>(n) - 1)};
    }
    return test;
}

}  // namespace

StepTableBuilder::StepTableBuilder(const SeamLayout& layout, const ImageShape& shape,
                                   std::size_t images, double rounding_step)
    : layout_(layout), shape_(shape), rounding_step_(rounding_step) {
    builders_.resize(images);
    for (auto& lines : builders_)
        for (const auto* list : {&layout_.seams, &layout_.controls})
            for (const Seam& line : *list)
                lines.emplace_back(line, layout_.section(line.a).keep, layout_.section(line.b).keep,
                                   shape);
}

void StepTableBuilder::add_row(int y, std::span<const double> reference,
                               std::span<const std::span<const double>> images) {
    for (std::size_t j = 0; j < images.size(); ++j)
        for (StepBuilder& line : builders_[j]) line.add_row(y, reference, images[j]);
}

StepTable StepTableBuilder::result() const {
    StepTable table;
    table.steps.resize(builders_.size());
    std::vector<std::vector<LineStep>> found(builders_.size());
    for (std::size_t j = 0; j < builders_.size(); ++j)
        for (const StepBuilder& line : builders_[j]) found[j].push_back(line.result());
    const std::size_t lines = layout_.seams.size() + layout_.controls.size();
    for (std::size_t i = 0; i < lines; ++i)
        for (int c = 0; c < shape_.channels; ++c) {
            if (c == shape_.alpha) continue;
            const bool seam = i < layout_.seams.size();
            const Seam& line = seam ? layout_.seams[i] : layout_.controls[i - layout_.seams.size()];
            const double length = line.to - line.from;
            table.columns.push_back(
                {line, seam ? static_cast<int>(i) : -1, c,
                 rounding_step_ * rounding_step_ / 12 * 2 / StepBuilder::window / length, length});
            for (std::size_t j = 0; j < found.size(); ++j)
                table.steps[j].push_back(found[j][i].channels[static_cast<std::size_t>(c)].value_or(
                    std::numeric_limits<double>::quiet_NaN()));
        }
    return table;
}

StepTest test_steps(const StepTable& renders, std::span<const double> judged, double spread) {
    const Scores scores = score(renders, renders.steps, judged, spread);
    StepTest test = judge(renders, scores, scores_of_each(renders, renders.steps),
                          static_cast<int>(renders.steps.size()));
    if (test.at)
        for (std::size_t k = 0; k < renders.columns.size(); ++k)
            if (renders.columns[k].seam == test.at->seam &&
                renders.columns[k].channel == test.at->channel)
                test.step = judged[k];
    return test;
}

std::vector<bool> step_alarms(const StepTable& renders) {
    std::vector<bool> alarms;
    for (std::size_t j = 0; j < renders.steps.size(); ++j) {
        const Steps others = without(renders.steps, j);
        const Scores scores = score(renders, others, renders.steps[j], 1);
        alarms.push_back(
            judge(renders, scores, scores_of_each(renders, others), static_cast<int>(others.size()))
                .alarm());
    }
    return alarms;
}

}  // namespace mpipov
