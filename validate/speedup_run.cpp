#include "speedup_run.h"

#include "compare.h"
#include "host_cpu.h"
#include "interrupt.h"
#include "launch_failure.h"
#include "povray_command.h"
#include "povray_text.h"
#include "printable.h"
#include "probe.h"
#include "program_files.h"
#include "result_file.h"
#include "run_child.h"
#include "run_image.h"
#include "scratch.h"
#include "user_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using Kind = SpeedupVariant::Kind;

std::optional<double> load_average() {
    double load = 0;
    return getloadavg(&load, 1) == 1 ? std::optional(load) : std::nullopt;
}

// Why a command failed that ended so; none where it did not.
std::optional<Failure> failure_of(const SpeedupVariant& variant, const SpeedupTools& tools,
                                  const Confinement& confinement, const ChildResult& result,
                                  const std::string& output) {
    if (result.exit_code == 0) return {};
    if (variant.kind == Kind::mpipov) return mpipov_failure(result, output, tools.mpiexec);
    const auto oiiotool = output.find("oiiotool ERROR");
    if (variant.kind == Kind::bands && oiiotool != std::string::npos)
        return Failure(Exit::scene,
                       output.substr(oiiotool, output.find('\n', oiiotool) - oiiotool));
    if (result.exit_code == 127)
        return Failure(Exit::scene, variant.kind == Kind::bands ? last_line(output)
                                                                : povray_not_found(tools.povray));
    return Failure(is_option_error(output) ? Exit::usage : Exit::scene,
                   printable(describe_failure(result, output, confinement)));
}

class SpeedupRun {
  public:
    SpeedupRun(const SpeedupRequest& request, SpeedupReport& report)
        : request_(request),
          report_(report),
          file_(request.folder / "speedup.json", has_times),
          confinement_(confinement_by(request.tools.rules, request.tools.povray, request.arguments,
                                      own_.path())) {}

    Exit run() {
        measure_into(file_, report_, [&] {
            ask_scene();
            for (const SpeedupVariant& variant : speedup_variants(request_.choice))
                report_.rows.push_back({variant, {}, {}, {}, {}, {}, {}});
            for (int i = 0; i < request_.repeat; ++i) repetition(i);
        });
        return outcome();
    }

  private:
    static bool has_times(const nlohmann::json& earlier) {
        const auto& rows = earlier.at("rows");
        return std::any_of(rows.begin(), rows.end(),
                           [](const auto& row) { return !row.at("times").empty(); });
    }

    void save() const { file_.write(to_json(report_)); }

    void ask_scene() {
        report_.versions["povray"] = povray_version(request_.tools.povray);
        tell_note(confinement_);
        const Probe probe = run_probe({request_.tools.povray,
                                       quote_arguments(request_.arguments),
                                       scratch_.path() / "probe",
                                       {},
                                       {},
                                       confinement_});
        const ImageOptions& image = probe.result.image;
        scene_ = {request_.arguments, image.width, image.region,
                  fs::path(image.output_file).extension().string()};
        report_.file = image.input_file;
        report_.scene = fs::path(image.input_file).stem().string();
        report_.order_dependent = probe.result.order_dependent;
    }

    void repetition(int index) {
        report_.repetitions.push_back({{}, load_average()});
        for (SpeedupRow& row : report_.rows) row.times.emplace_back();
        for (const std::size_t at : run_order(report_.rows.size(), index, request_.repeat)) {
            SpeedupRow& row = report_.rows[at];
            if (!row.failure.empty()) continue;
            throw_if_interrupted();
            report_.repetitions.back().order.push_back(row.variant.name());
            try {
                measure(row);  // the serial render comes first
                file_.replace_earlier();
                fmt::print(stderr, "repetition {} of {}: {} {:.2f} s\n", index + 1, request_.repeat,
                           row.variant.name(), *row.times.back());
            } catch (const Failure& failure) {
                // Without the serial render there is nothing to measure against.
                if (failure.code() == Exit::interrupted || row.variant.kind == Kind::serial) throw;
                row.failure = failure.what();
                row.times.back().reset();
                if (failed_ == Exit::ok) failed_ = failure.code();
                fmt::print(stderr, "{} failed: {}\n", row.variant.name(), row.failure);
            }
            save();
        }
    }

    void measure(SpeedupRow& row) {
        const SpeedupVariant& variant = row.variant;
        if (variant.kind == Kind::bands && variant.ranks > scene_.region.height())
            throw Failure(Exit::usage, fmt::format("{} rows cannot be cut into {} bands",
                                                   scene_.region.height(), variant.ranks));
        const fs::path place = scratch_.path() / variant.name();
        std::error_code error;
        fs::remove_all(place, error);
        if (!fs::create_directories(place, error))
            throw Failure(Exit::file,
                          fmt::format("cannot make '{}': {}", place.string(), error.message()));
        const fs::path record = request_.folder / (variant.name() + ".run.json");
        if (variant.kind == Kind::mpipov) fs::remove(record, error);

        row.argv = speedup_command(variant, request_.tools, scene_, place, record);
        std::string output;
        const ChildResult result = run_child(launch(variant, row.argv, place), &output);
        if (const auto failure = failure_of(variant, request_.tools, confinement_, result, output))
            throw *failure;
        row.times.back() = result.wall_seconds;

        if (variant.kind == Kind::mpipov) read_record(row, record);
        look_at_image(row, place / ("image" + scene_.extension));
        fs::remove_all(place, error);
    }

    // All that is to be set up for it is, before its time begins.
    ChildRequest launch(const SpeedupVariant& variant, const std::vector<std::string>& argv,
                        const fs::path& place) const {
        if (variant.kind == Kind::mpipov) {  // which confines its launches itself
            ChildRequest child;
            child.argv = argv;
            return child;
        }
        LaunchNeeds needs{argv, place, {}, variant.ranks, {}};
        if (variant.kind == Kind::bands) {
            // POV-Ray inherits what the shell, xargs and oiiotool need.
            FileAccess script = files_of_program(request_.tools.bands, home_of_user());
            resolve_links(script);
            needs.reads = script.read;
            needs.executes = script.execute;
        }
        return confinement_.request(std::move(needs));
    }

    void read_record(SpeedupRow& row, const fs::path& record) {
        const RunRecord run = mpipov::read_record(record);
        row.record = record;
        row.plan = {run.plan.sections, run.plan.threads, run.plan.in_flight};
        report_.versions.insert(run.versions.begin(), run.versions.end());
    }

    // The first serial image is what all later ones, serial ones too, are compared with.
    void look_at_image(SpeedupRow& row, const fs::path& image) {
        if (serial_image_.empty()) {
            serial_image_ = scratch_.path() / "reference" / image.filename();
            std::error_code error;
            fs::create_directories(serial_image_.parent_path(), error);
            fs::rename(image, serial_image_, error);
            if (error)
                throw Failure(Exit::file, fmt::format("POV-Ray wrote no '{}': {}", image.string(),
                                                      error.message()));
            report_.image = ImageSource(serial_image_).format();
            row.difference = SpeedupDifference{};
            return;
        }
        const Metrics metrics = compare_images({serial_image_, image, {}}).metrics;
        SpeedupDifference found{metrics.counts.differing, metrics.all.max()};
        if (!row.difference || found.differing >= row.difference->differing) {
            if (row.difference && found.largest < row.difference->largest)
                found.largest = row.difference->largest;
            row.difference = found;
        }
    }

    Exit outcome() const {
        if (failed_ != Exit::ok) return failed_;
        const bool broken =
            std::any_of(report_.rows.begin(), report_.rows.end(), [&](const SpeedupRow& row) {
                return row.variant.kind == Kind::mpipov && row.difference &&
                       row.difference->differing > 0;
            });
        return broken && !report_.order_dependent ? Exit::differ : Exit::ok;
    }

    const SpeedupRequest& request_;
    SpeedupReport& report_;
    ResultFile file_;
    const ScratchFolder scratch_{"speedup"}, own_{"own"};
    const Confinement confinement_;
    SpeedupScene scene_;
    fs::path serial_image_;
    Exit failed_ = Exit::ok;  // of the first variant that failed
};

}  // namespace

Exit run_speedup(const SpeedupRequest& request, SpeedupReport& report) {
    report.folder = request.folder;
    report.arguments = request.arguments;
    report.repeat = request.repeat;
    report.versions["mpipov"] = MPIPOV_VERSION;
    report.cores = static_cast<int>(std::thread::hardware_concurrency());
    report.cpu = cpu_name();
    return SpeedupRun(request, report).run();
}

}  // namespace mpipov
