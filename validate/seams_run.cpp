#include "seams_run.h"

#include "interrupt.h"
#include "json_output.h"
#include "run_child.h"
#include "scratch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

class SeamsRun {
  public:
    SeamsRun(const SeamsRequest& request, SeamsReport& report)
        : request_(request),
          report_(report),
          renderer_(request.povray, request.arguments, scratch_.path()) {}

    Exit run() {
        save();
        try {
            prepare();
            for (SeamsCase& one : planned()) run_case(one);
        } catch (const Failure& failure) {
            report_.failure = failure.what();
            save();
            throw;
        }
        report_.complete = true;
        save();
        return outcome_;
    }

  private:
    void save() const { write_json((request_.folder / "seams.json").string(), to_json(report_)); }

    void prepare() {
        scene_ = ask_scene(request_.povray, request_.arguments, scratch_.path());
        report_.versions["povray"] = scene_.povray_version;
        report_.scene = scene_.name;
        report_.file = scene_.file;
        const SerialRender& reference = add_reference("default", {});
        report_.image = ImageSource(reference.image).format();
        const auto halo = [](const SeamKind& kind) { return kind.seams == Seams::halo; };
        if (std::any_of(request_.seams.begin(), request_.seams.end(), halo))
            add_reference("oneblock", {fmt::format("+BS{}", scene_.longest_side)});
        report_.noise = find_noise({renderer_, report_.references.at("default"), request_.renders,
                                    scene_.order_dependent, request_.folder / "noise"});
        compare_noise(*report_.noise, report_.references.at("default"), {});
        if (report_.noise->why_not.empty()) {
            std::vector<fs::path> renders{report_.references.at("default").image};
            for (const NoiseRender& render : report_.noise->renders)
                renders.push_back(render.render.image);
            judge_.emplace(renders);
        }
        save();
    }

    const SerialRender& add_reference(const std::string& name,
                                      const std::vector<std::string>& more) {
        fmt::print(stderr, "rendering the serial reference: {}\n", name);
        return report_.references[name] = renderer_.render("serial-" + name, more, request_.folder);
    }

    std::vector<SeamsCase> planned() const {
        std::vector<SeamsCase> cases;
        for (const std::string& schedule : request_.schedules)
            for (const int ranks : request_.ranks)
                for (const Shape shape : request_.shapes)
                    for (const SeamKind& kind : request_.seams)
                        for (const int sections : request_.sections) {
                            SeamsCase one;
                            one.name = fmt::format("{}.np{}.{}.{}.g{}", schedule, ranks,
                                                   to_string(shape), kind.name(), sections);
                            one.schedule = schedule;
                            one.ranks = ranks;
                            one.shape = shape;
                            one.seams = kind.seams;
                            one.halo = kind.halo;
                            one.sections = sections;
                            one.reference = kind.seams == Seams::halo ? "oneblock" : "default";
                            cases.push_back(one);
                        }
        return cases;
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
        std::error_code ignored;
        fs::remove(one.run_file, ignored);
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
                      "--record",
                      one.run_file.string(),
                      "--povray",
                      request_.povray,
                      "--progress",
                      "none"};
        child.argv.insert(child.argv.end(), request_.arguments.begin(), request_.arguments.end());
        child.argv.push_back(fmt::format("+O{}", (folder / "image").string()));
        std::string output;
        const ChildResult result = run_child(child, &output);
        one.seconds = result.wall_seconds;
        if (result.exit_code == 127)
            throw Failure(Exit::file, fmt::format("cannot start '{}': is MPI installed, or named "
                                                  "with --mpiexec?",
                                                  request_.mpiexec));
        if (result.exit_code == static_cast<int>(Exit::usage)) {
            report_.skipped.push_back({one.name, last_line(output)});
            fs::remove(folder, ignored);
            save();
            return false;
        }
        if (result.exit_code != 0)
            throw Failure(
                result.exit_code == static_cast<int>(Exit::file) ? Exit::file : Exit::scene,
                fmt::format("mpipov failed: {}", last_line(output)));
        return true;
    }

    void judge(SeamsCase& one) {
        try {
            one.run = read_run_record(one.run_file);
        } catch (const std::exception& error) {
            throw Failure(Exit::file, error.what());
        }
        one.image = one.run->output;
        if (report_.effects.empty()) {
            report_.effects = one.run->plan.effects;
            compare_noise(*report_.noise, report_.references.at("default"), one.run);
        }
        const SerialRender& reference = report_.references.at(one.reference);
        one.comparison = compare_images({reference.image, one.image, one.run});
        const bool blocks = sees_blocks(reference.report);
        if (judge_) {
            JudgeRequest request{one.image, *one.run, {}};
            if (one.seams == Seams::halo && blocks) request.own_reference = reference.image;
            one.judgement = judge_->judge(request);
        }
        one.verdict = decide({one.comparison->identical(), one.comparison->metrics.counts.differing,
                              one.seams, blocks, report_.noise->exact, one.judgement});
    }

    const SeamsRequest& request_;
    SeamsReport& report_;
    ScratchFolder scratch_{"seams"};
    SerialRenderer renderer_;
    SceneAsked scene_;
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
