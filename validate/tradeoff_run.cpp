#include "tradeoff_run.h"

#include "host_cpu.h"
#include "interrupt.h"
#include "json_input.h"
#include "result_file.h"
#include "run_image.h"
#include "scratch.h"
#include "tradeoff_measure.h"
#include "tradeoff_renders.h"
#include "tradeoff_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string_view>
#include <thread>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool has_times(const json& earlier) {
    const json& rows = earlier.at("rows");
    return std::any_of(rows.begin(), rows.end(),
                       [](const json& row) { return !row.at("wall").empty(); });
}

class Sweeper {
  public:
    Sweeper(const TradeoffRequest& request, TradeoffReport& report)
        : request_(request),
          report_(report),
          file_(request.folder / "tradeoff.json", has_times),
          renderer_({request.povray, request.mpiexec, request.mpipov, request.rules},
                    request.arguments, scratch_.path()) {}

    Exit run() {
        tell_note(renderer_.serial().confinement());
        ask_scene(request_.povray, make_scratch("probe"), renderer_.serial().confinement(),
                  report_);
        plan();
        go_on_from_earlier();
        measure_into(file_, report_, [&] {
            repetition(0);
            make_truth();
            for (int i = 1; i < request_.repeat; ++i) repetition(i);
            add_ssim(report_);
            pick();
        });
        return outcome();
    }

  private:
    void save() const { file_.write(to_json(report_)); }

    fs::path make_scratch(const char* name) const {
        fs::path folder = scratch_.path() / name;
        fs::create_directories(folder);
        return folder;
    }

    void plan() {
        const TradeoffPlan plan = plan_tradeoff(request_.choice, report_.calls);
        report_.left_out = plan.left_out;
        for (const TradeoffSetting& setting : plan.settings) {
            TradeoffRow row;
            row.setting = setting;
            row.argv = renderer_.argv(setting);
            row.user_argv = renderer_.user_argv(setting);
            report_.rows.push_back(std::move(row));
        }
    }

    // What an earlier call measured here of the same job stays.
    void go_on_from_earlier() {
        if (!file_.keeps_earlier()) return;
        try {
            std::ifstream in(request_.folder / "tradeoff.json");
            const json earlier = parse_json(in);
            const std::string changed = what_changed_since(report_, earlier);
            if (!changed.empty()) {
                fmt::print(stderr, "measuring all again: {}\n", changed);
                return;
            }
            take_measured(report_, earlier);
            const auto taken = std::count_if(report_.rows.begin(), report_.rows.end(),
                                             [](const TradeoffRow& row) { return row.measured(); });
            fmt::print(stderr, "going on from an earlier measurement: {} of {} settings{}\n", taken,
                       report_.rows.size(), report_.truth ? ", and the truth" : "");
            file_.replace_earlier();
        } catch (const std::exception& error) {
            fmt::print(stderr, "measuring all again: tradeoff.json cannot be used: {}\n",
                       error.what());
            report_.truth.reset();
        }
    }

    void repetition(int index) {
        for (const std::size_t at : run_order(report_.rows.size(), index, request_.repeat)) {
            TradeoffRow& row = report_.rows[at];
            if (!row.failure.empty() || static_cast<int>(row.wall.size()) > index) continue;
            throw_if_interrupted();
            try {
                measure(row);
                fmt::print(stderr, "repetition {} of {}: {} {:.2f} s ({} of {} renders done)\n",
                           index + 1, request_.repeat, row.setting.name, row.wall.back(), done(),
                           report_.rows.size() * static_cast<std::size_t>(request_.repeat));
            } catch (const Failure& failure) {
                // Without any serial render there is nothing to compare.
                if (failure.code() == Exit::interrupted || !row.setting.mpipov) throw;
                row.failure = failure.what();
                row.impossible = failure.code() == Exit::usage && row.wall.empty();
                if (!row.impossible && failed_ == Exit::ok) failed_ = failure.code();
                fmt::print(stderr, "{}: {}\n", row.setting.name, row.failure);
            }
            save();
        }
        leave_out_impossible();
    }

    std::size_t done() const {
        std::size_t count = 0;
        for (const TradeoffRow& row : report_.rows)
            count += std::min(row.wall.size(), static_cast<std::size_t>(request_.repeat));
        return count;
    }

    // mpipov refused them in the first repetition: there is no such grid. Its own words say why.
    void leave_out_impossible() {
        constexpr std::string_view ours = "mpipov failed: mpipov: ";
        for (const TradeoffRow& row : report_.rows)
            if (row.impossible)
                report_.left_out.push_back(
                    {row.setting.name,
                     row.failure.substr(row.failure.starts_with(ours) ? ours.size() : 0)});
        std::erase_if(report_.rows, [](const TradeoffRow& row) { return row.impossible; });
    }

    void measure(TradeoffRow& row) {
        const TradeoffRun run = renderer_.run(row.setting);
        file_.replace_earlier();
        const std::string sha1 = pixel_sha1(run.image);
        if (row.wall.empty()) {
            row.image = make_images_folder() / (row.setting.name + ".png");
            std::error_code error;
            fs::copy_file(run.image, row.image, fs::copy_options::overwrite_existing, error);
            if (error)
                throw Failure(Exit::file, fmt::format("cannot write '{}': {}", row.image.string(),
                                                      error.message()));
            row.pixel_sha1 = sha1;
            row.sections = run.sections;
            if (!report_.image) report_.image = ImageSource(row.image).format();
        }
        row.varies = row.varies || sha1 != row.pixel_sha1;
        row.wall.push_back(run.wall_seconds);
        row.cpu.push_back(run.cpu_seconds);
    }

    fs::path make_images_folder() const {
        fs::path folder = request_.folder / "images";
        std::error_code error;
        fs::create_directories(folder, error);
        return folder;
    }

    // More samples until its own error is small beside the best setting's, or it would take too
    // much.
    void make_truth() {
        if (!report_.truth) render_truth_of(1);
        for (;;) {
            add_errors(report_);
            save();
            const Truth& truth = *report_.truth;
            const std::optional<std::size_t> best = most_accurate(report_);
            if (!best) return;
            const double wanted = report_.truth_share * report_.rows[*best].truth->rms / 255;
            report_.truth_stopped.clear();
            if (truth.error() <= wanted) break;
            const int by_samples =
                deepest_within(request_.most_samples, std::numeric_limits<double>::max(), truth);
            const int most = deepest_within(request_.most_samples, request_.truth_seconds, truth);
            const int next = next_depth(truth.depth, truth.error(), wanted, most);
            if (next == truth.depth) {
                report_.truth_stopped =
                    by_samples > truth.depth ? "more samples would take longer than --truth-seconds"
                    : by_samples == deepest_truth ? "more samples cannot be had"
                                                  : "more samples are more than --truth-samples";
                break;
            }
            render_truth_of(next);
        }
        say_other_averaging();
    }

    void render_truth_of(int depth) {
        throw_if_interrupted();
        fmt::print(stderr, "rendering the truth with {} samples a pixel\n", truth_samples(depth));
        report_.truth =
            render_truth(renderer_.serial(),
                         {report_.width, report_.height, report_.region, depth, report_.averaging,
                          report_.calls.order_dependent, report_.cores},
                         scratch_.path() / "truth", make_images_folder());
        fmt::print(stderr, "its own error is {:.3g} levels of 255 ({:.1f} s)\n",
                   255 * report_.truth->error(), report_.truth->wall_seconds);
    }

    void say_other_averaging() {
        const std::optional<std::size_t> best = most_accurate(report_);
        if (!best) return;
        report_.other_averaging_error =
            error_of(report_, report_.truth->other, report_.rows[*best].image).rms;
        const double here = report_.rows[*best].truth->rms;
        if (report_.averaging == Averaging::linear && *report_.other_averaging_error < here / 2)
            report_.notes.push_back(fmt::format(
                "POV-Ray averages this scene's samples in encoded values, not in linear light (it "
                "has no assumed_gamma 1): against a truth averaged like that the best setting is "
                "{:.3g} off, not {:.3g}, see --average",
                *report_.other_averaging_error, here));
    }

    void pick() {
        const std::vector<std::optional<TradeoffPoint>> points = points_of(report_, true);
        if (request_.max_error)
            report_.picks.push_back(
                {"--max-error", *request_.max_error, cheapest_within(points, *request_.max_error)});
        if (request_.max_seconds)
            report_.picks.push_back({"--max-seconds", *request_.max_seconds,
                                     most_accurate_within(points, *request_.max_seconds)});
    }

    Exit outcome() const {
        if (failed_ != Exit::ok) return failed_;
        const bool none = std::any_of(report_.picks.begin(), report_.picks.end(),
                                      [](const TradeoffPick& pick) { return !pick.row; });
        return none ? Exit::differ : Exit::ok;
    }

    const TradeoffRequest& request_;
    TradeoffReport& report_;
    ResultFile file_;
    const ScratchFolder scratch_{"tradeoff"};
    TradeoffRenderer renderer_;
    Exit failed_ = Exit::ok;  // of the first setting that failed
};

}  // namespace

Exit run_tradeoff(const TradeoffRequest& request, TradeoffReport& report) {
    report.folder = request.folder;
    report.arguments = request.arguments;
    report.repeat = request.repeat;
    report.ranks = request.choice.ranks;
    report.averaging = request.averaging;
    report.versions["mpipov"] = MPIPOV_VERSION;
    report.cores = static_cast<int>(std::thread::hardware_concurrency());
    report.cpu = cpu_name();
    return Sweeper(request, report).run();
}

}  // namespace mpipov
