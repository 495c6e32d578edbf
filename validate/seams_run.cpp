#include "seams_run.h"

#include "interrupt.h"
#include "render_options.h"
#include "result_file.h"
#include "run_child.h"
#include "run_image.h"
#include "seams_conditioning.h"
#include "serial_stage.h"
#include "set_aside.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

class SeamsRun {
  public:
    SeamsRun(const SeamsRequest& request, SeamsReport& report)
        : request_(request),
          report_(report),
          file_(request.folder / "seams.json", has_cases),
          stage_(request.folder),
          conditioning_(request.arguments, request.povray, request.rules,
                        request.folder / "conditioning") {}

    Exit run() {
        measure_into(file_, report_, [&] {
            prepare();
            for (SeamsCase& one : planned()) run_case(one);
            add_ssim();
        });
        if (report_.cases.empty() && !report_.skipped.empty())
            throw Failure(Exit::usage,
                          fmt::format("nothing was judged: {}: {}", report_.skipped.front().name,
                                      report_.skipped.front().why));
        return outcome_;
    }

  private:
    static bool has_cases(const nlohmann::json& earlier) { return !earlier.at("cases").empty(); }

    void save() const { file_.write(to_json(report_)); }

    void prepare() {
        const auto halo = [](const SeamKind& kind) { return kind.seams == Seams::halo; };
        const SerialRequest wanted{request_.arguments, request_.renders, request_.povray,
                                   std::any_of(request_.seams.begin(), request_.seams.end(), halo),
                                   request_.rules};
        if (request_.serial.empty()) {
            report_.serial = render_serial_set(wanted, stage_.path());
        } else {
            report_.serial = read_serial_set(wanted, request_.serial);
        }
        const SerialSet& serial = *report_.serial;
        report_.versions["povray"] = serial.scene.povray_version;
        report_.image = ImageSource(serial.reference().image).format();
        if (!file_.keeps_earlier()) settle();
        save();
    }

    // The folder is this measurement's from now on; until then an earlier one's stays whole.
    void settle() {
        if (settled_) return;
        settled_ = true;
        file_.replace_earlier();
        if (request_.serial.empty())
            stage_.keep(*report_.serial);
        else
            for (auto& [name, render] : report_.serial->references) bring_here(render.image);
        const SerialSet& serial = *report_.serial;
        if (serial.noise.why_not.empty()) {
            std::vector<fs::path> renders{serial.reference().image};
            for (const NoiseRender& render : serial.noise.renders)
                renders.push_back(render.render.image);
            judge_.emplace(renders);
        }
    }

    // The report shows only what lies in its own folder.
    void bring_here(fs::path& image) const {
        const fs::path here = request_.folder / image.filename();
        std::error_code error;
        if (fs::equivalent(image, here, error)) return;
        fs::copy_file(image, here, fs::copy_options::overwrite_existing, error);
        if (error)
            throw Failure(Exit::file,
                          fmt::format("cannot write '{}': {}", here.string(), error.message()));
        image = here;
    }

    std::vector<SeamsCase> planned() const {
        std::vector<SeamsCase> cases;
        for (const Policy schedule : request_.schedules)
            for (const int ranks : request_.ranks)
                for (const Shape shape : request_.shapes)
                    for (const SeamKind& kind : request_.seams)
                        for (const int sections : request_.sections)
                            for (const std::string& radiosity : request_.radiosity) {
                                SeamsCase one;
                                one.schedule = to_string(schedule);
                                one.ranks = ranks;
                                one.shape = shape;
                                one.seams = kind.seams;
                                one.halo = kind.halo;
                                one.sections = sections;
                                one.radiosity = radiosity;
                                one.name = name_of(one);
                                one.reference = reference_for(kind.seams);
                                cases.push_back(one);
                            }
        return cases;
    }

    // Also that of a folder.
    static std::string name_of(const SeamsCase& one) {
        std::string name =
            fmt::format("{}.np{}.{}.{}.g{}", one.schedule, one.ranks, to_string(one.shape),
                        SeamKind{one.seams, one.halo}.name(), one.sections);
        if (one.radiosity == "auto") return name;
        name += '.';
        std::ranges::remove_copy(one.radiosity, std::back_inserter(name), ':');
        return name;
    }

    // Halo reproduces the render in one block, which is another where antialiasing sees blocks.
    std::string reference_for(Seams seams) const {
        const bool other = seams == Seams::halo && report_.serial->references.contains("oneblock");
        return other ? "oneblock" : "default";
    }

    void run_case(SeamsCase& one) {
        throw_if_interrupted();
        fmt::print(stderr, "{}\n", one.name);
        try {
            if (!render(one)) return;
            judge(one);
        } catch (const Failure& failure) {
            if (failure.code() == Exit::interrupted) throw;
            one.failure = failure.what();
            one.verdict = {Verdict::Kind::failed, false, one.failure};
            outcome_ = failure.code();
        }
        if (!one.verdict.ok && outcome_ == Exit::ok) outcome_ = Exit::differ;
        report_.cases.push_back(std::move(one));
        save();
    }

    // False where mpipov says that there is no such grid.
    bool render(SeamsCase& one) {
        const fs::path folder = make_folder(request_.folder / one.name);
        one.run_file = folder / "run.json";
        SetAside earlier(one.run_file);
        if (settled_) earlier.drop();
        std::error_code ignored;
        const SeamKind kind{one.seams, one.halo};
        ChildRequest child;
        child.argv = {request_.mpiexec,
                      "-n",
                      fmt::format("{}", one.ranks),
                      request_.mpipov.string(),
                      "--schedule",
                      one.schedule,
                      "--shape",
                      std::string(to_string(one.shape)),
                      "--seams",
                      kind.text(),
                      "--sections",
                      fmt::format("{}", one.sections),
                      "--radiosity",
                      one.radiosity,
                      "--record",
                      one.run_file.string(),
                      "--povray",
                      request_.povray,
                      "--progress",
                      "none"};
        for (const auto* more : {&request_.rules.given, &request_.arguments})
            child.argv.insert(child.argv.end(), more->begin(), more->end());
        child.argv.push_back(fmt::format("+O{}", (folder / "image").string()));
        std::string output;
        const ChildResult result = run_child(child, &output);
        one.seconds = result.wall_seconds;
        if (result.exit_code == 127) throw mpipov_failure(result, output, request_.mpiexec);
        if (result.exit_code == static_cast<int>(Exit::usage)) {
            report_.skipped.push_back({one.name, last_line(output)});
            fs::remove(folder, ignored);
            save();
            return false;
        }
        settle();
        earlier.drop();
        if (result.exit_code != 0) throw mpipov_failure(result, output, request_.mpiexec);
        return true;
    }

    void judge(SeamsCase& one) {
        one.run = read_record(one.run_file);
        one.image = one.run->output;
        SerialSet& serial = *report_.serial;
        if (report_.effects.empty()) {
            report_.effects = one.run->plan.effects;
            compare_noise(serial, one.run);
        }
        const SerialRender& reference = serial.references.at(one.reference);
        one.comparison = compare_images({reference.image, one.image, one.run});
        const bool blocks = sees_blocks(reference.report);
        if (judge_) {
            JudgeRequest request{one.image, *one.run, {}};
            if (one.reference != "default") request.own_reference = reference.image;
            one.judgement = judge_->judge(request);
        }
        one.verdict = decide({one.comparison->identical(), one.comparison->metrics.counts.differing,
                              one.seams, blocks, is_exact(serial.noise),
                              worst_section_share(*one.comparison), one.judgement});
        if (!one.verdict.ok && request_.conditioning)
            conditioning_.reconsider(one, reference.image, report_);
    }

    static double worst_section_share(const Comparison& comparison) {
        double worst = 0;
        if (comparison.seams)
            for (const SectionErrors& section : comparison.seams->sections)
                worst = std::max(worst, static_cast<double>(section.group.counts.differing) /
                                            static_cast<double>(section.group.counts.pixels));
        return worst;
    }

    // At the end and all at once. Missing it is told in its place, and no reason for no verdict.
    void add_ssim() {
        std::vector<SsimPair> pairs;
        std::vector<Comparison*> differing;
        for (SeamsCase& one : report_.cases) {
            if (!one.comparison) continue;
            if (one.comparison->identical()) {
                one.comparison->ssim = ssim_of_identical();
                continue;
            }
            pairs.push_back({one.comparison->a, one.comparison->b, {}});
            differing.push_back(&*one.comparison);
        }
        try {
            const std::vector<Ssim> found = compute_ssim(pairs, 1);
            for (std::size_t i = 0; i < found.size(); ++i) differing[i]->ssim = found[i];
        } catch (const Failure& failure) {
            if (failure.code() == Exit::interrupted) throw;
            for (Comparison* comparison : differing)
                comparison->ssim = Ssim{{}, {}, failure.what()};
        }
    }

    const SeamsRequest& request_;
    SeamsReport& report_;
    ResultFile file_;
    const SerialStage stage_;
    SeamsConditioning conditioning_;
    bool settled_ = false;
    std::optional<SeamJudge> judge_;
    Exit outcome_ = Exit::ok;
};

}  // namespace

std::string SeamKind::text() const {
    return seams == Seams::halo ? fmt::format("halo:{}", halo) : std::string(to_string(seams));
}

std::string SeamKind::name() const {
    return seams == Seams::halo ? fmt::format("halo{}", halo) : std::string(to_string(seams));
}

Exit run_seams(const SeamsRequest& request, SeamsReport& report) {
    report.folder = request.folder;
    report.arguments = request.arguments;
    report.versions["mpipov"] = MPIPOV_VERSION;
    return SeamsRun(request, report).run();
}

}  // namespace mpipov
