// Where the terms' values come from: constants that were measured once, and a run's record.
#include "image_file.h"
#include "launch_costs.h"
#include "simulate_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace mpipov {
namespace {

// Measured, docs/simulation.md says how.
constexpr double answer_seconds = 0.025;
constexpr double service_seconds = 1.0 / 2000;
constexpr double before_seconds = 0.5;
constexpr double after_seconds = 0.03, after_pixel_seconds = 70e-9;

const char* const no_scene = "no run of the scene says that it has any";
const char* const one_host = "all ranks are on one host";

double cpu_of(const PlanRecord& plan, const std::string& effect) {
    const auto found = plan.effects.find(effect);
    return found == plan.effects.end() || !found->second.on ? 0
                                                            : found->second.cpu_seconds.value_or(0);
}

bool is_on(const PlanRecord& plan, const std::string& effect) {
    const auto found = plan.effects.find(effect);
    return found != plan.effects.end() && found->second.on;
}

std::string why(const PlanRecord& plan, const std::string& effect) {
    const auto found = plan.effects.find(effect);
    return found == plan.effects.end() ? "the record does not tell" : found->second.why;
}

// What of the launches' CPU is no tracing. The plan's own estimate, cut to what the cheapest
// section took as a whole.
double per_launch_cpu(const RunRecord& record) {
    const PlanRecord& plan = record.plan;
    // As gathering_cost() adds them up (cost_model.h).
    double launches = std::max(1, plan.sections), pixels = 0;
    for (const WaveRecord& wave : record.waves)
        for (const SectionRecord& section : wave.sections) {
            launches += 1;
            pixels += static_cast<double>(section.section.render.area());
        }
    const double traces = 1 + pixels / static_cast<double>(std::max(1LL, plan.region.area()));
    const double saved = record.waves.empty() ? 0 : cpu_of(plan, "radiosity");
    const double planned =
        (plan.predicted.cpu_seconds - traces * cpu_of(plan, "render") + plan.sections * saved) /
            launches -
        saved;
    const auto cheapest = std::min_element(record.sections.begin(), record.sections.end(),
                                           [](const SectionRecord& a, const SectionRecord& b) {
                                               return a.cpu_seconds < b.cpu_seconds;
                                           });
    return std::clamp(planned, 0.0, cheapest->cpu_seconds);
}

// POV-Ray's threads compute side by side, so only one thread's wall time tells what was idle; and
// only of a launch that did not wait for a core which others had.
void take_start_up(const RunRecord& record, std::vector<SimulateTerm>& terms) {
    const auto shares_cores = [&](const RankRecord& rank) {
        return rank.slots > 0 && record.plan.in_flight > rank.slots;
    };
    if (record.plan.threads != 1 ||
        std::any_of(record.ranks.begin(), record.ranks.end(), shares_cores))
        return;
    double idle = never;
    for (const SectionRecord& section : record.sections)
        idle = std::min(idle, section.wall_seconds - section.cpu_seconds);
    if (idle > 0 && idle < 2 * startup_wall_seconds)
        set_term(terms, term::start, idle, "the record: least wall - CPU of a launch");
}

void take_launch(const RunRecord& record, std::vector<SimulateTerm>& terms) {
    const PlanRecord& plan = record.plan;
    const double all = per_launch_cpu(record);
    const bool reads_cache = !record.waves.empty();
    const double photons = cpu_of(plan, "photons"),
                 radiosity = reads_cache ? 0 : cpu_of(plan, "radiosity");
    double frame = frame_pixel_cpu_seconds * plan.image.width * plan.image.height,
           bare = bare_launch_cpu_seconds;
    const double known = photons + radiosity + frame + bare;
    // What the cheapest section did not take is taken from all alike.
    const double part = known > all ? all / known : 1;
    const std::string source = part < 1 ? "the record, cut to its cheapest section" : "the record";
    set_term(terms, term::bare, bare * part, part < 1 ? source : "docs/simulation.md");
    set_term(terms, term::frame, frame * part,
             part < 1 ? source : "70 ns for each pixel of the whole image, docs/simulation.md");
    set_term(terms, term::parse, std::max(0.0, all - known), source + ": the rest of a launch");
    for (const auto& [name, effect, cpu] :
         {std::tuple{term::photons, "photons", photons}, {term::radiosity, "radiosity", radiosity}})
        if (reads_cache && name == term::radiosity)
            switch_off(terms, name, "the sections read a cache, see gathering");
        else if (is_on(plan, effect))
            set_term(terms, name, cpu * part, source);
        else
            switch_off(terms, name, why(plan, effect));
}

void take_ends(const RunRecord& record, std::vector<SimulateTerm>& terms) {
    double first = never, last = 0;
    std::vector<const std::vector<SectionRecord>*> parts{&record.sections, &record.repairs};
    for (const WaveRecord& wave : record.waves) parts.push_back(&wave.sections);
    for (const std::vector<SectionRecord>* all : parts)
        for (const SectionRecord& section : *all) {
            first = std::min(first, section.start);
            last = std::max(last, section.end);
        }
    set_term(terms, term::before, first, "the record: start of the first section");
    set_term(terms, term::after, std::max(0.0, record.totals.wall_seconds - last),
             "the record: after the last section");
}

// Tracing in the waves is what their sections took above a launch, as it is for the image's.
void take_waves(const RunRecord& record, SimulateCase& what) {
    const double launch = per_launch_cpu(record);
    double sum = 0;
    for (const WaveRecord& wave : record.waves) {
        std::vector<double>& cpu = what.waves.emplace_back();
        for (const SectionRecord& section : wave.sections) {
            cpu.push_back(std::max(0.0, section.cpu_seconds - launch));
            sum += cpu.back();
        }
    }
    if (!record.waves.empty())
        set_term(what.terms, term::gathering, sum,
                 fmt::format("the record: {} waves", record.waves.size()));
}

// How many there were, some of which an earlier run may have made.
std::size_t waves_of_plan(const RunRecord& record) {
    Partition partition;
    partition.request.region = record.plan.region;
    for (const SectionRecord& section : record.sections)
        partition.sections.push_back(section.section);
    return gather_waves(record.plan.radiosity, {record.plan.image.width, record.plan.image.height},
                        partition)
        .size();
}

}  // namespace

std::vector<SimulateTerm> default_terms(int width, int height) {
    const double pixels = static_cast<double>(width) * height;
    const std::string doc = "docs/simulation.md";
    return {
        {term::start, startup_wall_seconds, "s, core idle, each launch", true, doc},
        {term::end, 0, "s, core idle, each launch", false, "counted with the start-up"},
        {term::bare, bare_launch_cpu_seconds, "CPU s, each launch", true, doc},
        {term::parse, 0, "CPU s, each launch", false, no_scene},
        {term::photons, 0, "CPU s, each launch, by all threads", false, no_scene},
        {term::radiosity, 0, "CPU s, each launch, by all threads", false, no_scene},
        {term::frame, frame_pixel_cpu_seconds * pixels, "CPU s, each launch", true,
         "70 ns for each pixel of the whole image, " + doc},
        {term::answer, answer_seconds, "s, each section, lane idle", true, doc},
        {term::service, service_seconds, "s of rank 0's loop, each section", true, doc},
        {term::rank0, service_seconds, "CPU s of rank 0's core, each section", true, doc},
        {term::latency, 50e-6, "s, each message", false, one_host},
        {term::bandwidth, 125e6, "bytes/s into rank 0", false, one_host},
        {term::before, before_seconds, "s before the first section", true, doc},
        {term::after, after_seconds + after_pixel_seconds * pixels, "s after the last section",
         true, doc},
        {term::gathering, 0, "CPU s before the sections, in waves of sections", false, no_scene},
        {term::copies, 0, "by idle ranks, of the last sections", true, "Schedule::next_copy"},
        {term::uneven, 0, "what tracing costs where", true, "the cost map"},
    };
}

SimulateCase case_of_run(const RunRecord& record) {
    if (!record.complete) throw std::invalid_argument("the run was not finished");
    if (record.sections.empty()) throw std::invalid_argument("the record has no sections");
    if (record.waves.size() != waves_of_plan(record) ||
        std::ranges::any_of(record.sections, &SectionRecord::resumed))
        throw std::invalid_argument("the run went on from another: its times are not of one run");
    const PlanRecord& plan = record.plan;
    SimulateCase what;
    what.costs = costs_of_run(record, per_launch_cpu(record));
    what.costs_from = fmt::format("the CPU seconds of {} sections, {:.3g} each for the launch",
                                  record.sections.size(), per_launch_cpu(record));
    what.width = plan.image.width;
    what.height = plan.image.height;
    what.grid = {plan.region, plan.shape, plan.seams, 1, plan.halo, plan.block};
    what.bytes_per_pixel =
        static_cast<double>(plan.image.channels) *
        static_cast<double>(bytes_per_value(depth_from_string(plan.image.depth)));
    what.threads = plan.threads;
    what.terms = default_terms(what.width, what.height);
    take_start_up(record, what.terms);
    take_launch(record, what.terms);
    take_ends(record, what.terms);
    take_waves(record, what);
    if (is_on(plan, "order_dependent")) what.sections = plan.sections;
    return what;
}

}  // namespace mpipov
