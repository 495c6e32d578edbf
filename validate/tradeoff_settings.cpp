#include "tradeoff_settings.h"

#include "failure.h"

#include <fmt/format.h>

#include <algorithm>

namespace mpipov {
namespace {

class Planner {
  public:
    Planner(const TradeoffChoice& choice, const SceneCalls& scene)
        : choice_(choice), scene_(scene), method_1_(!has_own() || scene.antialiasing.method == 1) {
        if (!has_own()) plan_.base_antialiasing = {"+A0.3", "+AM1", "+R3"};
    }

    TradeoffPlan plan() {
        if (wanted(Sweep::antialiasing)) antialiasing();
        if (wanted(Sweep::decomposition)) decomposition();
        if (wanted(Sweep::radiosity)) radiosity();
        if (wanted(Sweep::threads)) threads();
        if (plan_.settings.empty())
            throw Failure(Exit::usage, plan_.left_out.empty()
                                           ? std::string("nothing is left to sweep")
                                           : fmt::format("nothing is left to sweep: {}: {}",
                                                         plan_.left_out.front().what,
                                                         plan_.left_out.front().why));
        return std::move(plan_);
    }

  private:
    bool has_own() const { return scene_.antialiasing.on; }
    bool wanted(Sweep sweep) const {
        return choice_.sweeps.empty() || std::find(choice_.sweeps.begin(), choice_.sweeps.end(),
                                                   sweep) != choice_.sweeps.end();
    }
    // False too where it was left out.
    bool makes_sense(Sweep sweep, bool sense, const std::string& why) {
        if (!sense) plan_.left_out.push_back({std::string(to_string(sweep)), why});
        return sense;
    }

    void serial(const std::string& name, const std::string& what, Sweep sweep,
                std::vector<std::string> arguments, const std::string& compared_with = {}) {
        const bool known =
            std::any_of(plan_.settings.begin(), plan_.settings.end(),
                        [&](const TradeoffSetting& other) { return other.name == name; });
        if (!known)
            plan_.settings.push_back(
                {name, what, sweep, false, 1, {}, std::move(arguments), compared_with});
    }

    void supersampled(int method, int depth, double threshold) {
        serial(fmt::format("aa-m{}-d{}-t{:g}", method, depth, threshold),
               fmt::format("method {}, depth {}, threshold {:g}", method, depth, threshold),
               Sweep::antialiasing,
               {fmt::format("+A{:g}", threshold), fmt::format("+AM{}", method),
                fmt::format("+R{}", depth)});
    }

    void antialiasing() {
        serial("aa-off", "no antialiasing", Sweep::antialiasing, {"-A"});
        const std::vector<double>& thresholds = choice_.thresholds;
        for (const int method : choice_.methods) {
            for (const int depth : choice_.depths) supersampled(method, depth, middle(thresholds));
            for (const double threshold : thresholds)
                supersampled(method, middle(choice_.depths), threshold);
            supersampled(method, choice_.depths.back(), thresholds.back());
        }
    }

    void base_serial() {
        serial("serial", "serial, antialiasing as of the sections", Sweep::decomposition,
               plan_.base_antialiasing);
    }

    void in_sections(Sweep sweep, const std::string& name, const std::string& what, int ranks,
                     std::vector<std::string> options, const std::string& compared_with) {
        plan_.settings.push_back({name, what, sweep, true, ranks, std::move(options),
                                  plan_.base_antialiasing, compared_with});
    }

    void cut(const std::string& seams, int sections, const std::string& compared_with) {
        std::string short_name = seams;
        std::erase(short_name, ':');
        in_sections(Sweep::decomposition, fmt::format("{}-g{}", short_name, sections),
                    fmt::format("{}, {} sections", seams, sections), choice_.ranks,
                    {"--slots", "1", "--threads", "1", "--shape", "tiles", "--seams", seams,
                     "--sections", fmt::format("{}", sections)},
                    compared_with);
    }

    // Where antialiasing does not see blocks there is nothing that the place of a seam could
    // change.
    void decomposition() {
        base_serial();
        const std::string line = method_1_ ? "aligned" : "plain";
        for (const int sections : choice_.sections) cut(line, sections, "serial");
        if (!method_1_) {
            plan_.left_out.push_back(
                {"seams other than plain",
                 "antialiasing of method 2 looks at no pixel but its own, so no seam matters"});
            return;
        }
        cut("plain", middle(choice_.sections), "serial");
        if (choice_.halos.empty()) return;
        serial("serial-oneblock", "serial in one block, which halo reproduces",
               Sweep::decomposition, with(fmt::format("+BS{}", scene_.longest_side)), "serial");
        for (const int halo : choice_.halos)
            cut(fmt::format("halo:{}", halo), middle(choice_.sections), "serial-oneblock");
    }

    std::vector<std::string> with(const std::string& more) const {
        std::vector<std::string> arguments = plan_.base_antialiasing;
        arguments.push_back(more);
        return arguments;
    }

    void radiosity() {
        if (!makes_sense(Sweep::radiosity, scene_.radiosity, "the scene has no radiosity")) return;
        base_serial();
        for (const std::string& way : choice_.radiosity) shared(way);
    }

    void shared(const std::string& way) {
        const std::size_t slash = std::min(way.find('/'), way.size());
        const std::string how = way.substr(0, slash);
        const std::string sections = fmt::format("{}", middle(choice_.sections));
        std::string name = "radiosity-" + how, what = "radiosity " + how;
        std::replace(name.begin(), name.end(), ':', '-');
        std::vector<std::string> options{"--slots",     "1",     "--threads",  "1",
                                         "--shape",     "tiles", "--sections", sections,
                                         "--radiosity", how};
        if (slash < way.size()) {
            const std::string scale = way.substr(slash + 1);
            name += "-scale-" + scale;
            what += " at 1/" + scale + " of the size";
            options.insert(options.end(), {"--radiosity-scale", scale});
        }
        in_sections(Sweep::radiosity, name, fmt::format("{}, {} sections", what, sections),
                    choice_.ranks, options, "serial");
    }

    void threads() {
        if (!makes_sense(Sweep::threads, !scene_.order_dependent,
                         "the scene depends on the order of rendering: with more than one thread "
                         "its picture is another each time"))
            return;
        base_serial();
        for (const int threads : choice_.threads)
            in_sections(
                Sweep::threads, fmt::format("threads-{}", threads),
                fmt::format("{} thread{} a launch, one rank", threads, threads == 1 ? "" : "s"), 1,
                {"--slots", fmt::format("{}", threads), "--threads", fmt::format("{}", threads),
                 "--shape", "tiles", "--sections", fmt::format("{}", middle(choice_.sections))},
                "serial");
    }

    const TradeoffChoice& choice_;
    const SceneCalls& scene_;
    bool method_1_;
    TradeoffPlan plan_;
};

}  // namespace

std::string_view to_string(Sweep sweep) {
    switch (sweep) {
        case Sweep::antialiasing:
            return "antialiasing";
        case Sweep::decomposition:
            return "decomposition";
        case Sweep::radiosity:
            return "radiosity";
        case Sweep::threads:
            break;
    }
    return "threads";
}

TradeoffPlan plan_tradeoff(const TradeoffChoice& choice, const SceneCalls& scene) {
    return Planner(choice, scene).plan();
}

}  // namespace mpipov
