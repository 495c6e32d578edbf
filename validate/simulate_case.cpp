#include "simulate_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace mpipov {
namespace {

const SimulateTerm* find(const std::vector<SimulateTerm>& terms, const std::string& name) {
    const auto it = std::find_if(terms.begin(), terms.end(),
                                 [&](const SimulateTerm& one) { return one.name == name; });
    return it == terms.end() ? nullptr : &*it;
}

SimulateTerm& require(std::vector<SimulateTerm>& terms, const std::string& name) {
    const auto it = std::find_if(terms.begin(), terms.end(),
                                 [&](const SimulateTerm& one) { return one.name == name; });
    if (it == terms.end()) throw std::logic_error("no term '" + name + "'");
    return *it;
}

GridRequest grid_of(const SimulateCase& what, int sections) {
    GridRequest grid = what.grid;
    grid.sections = sections;
    if (what.auto_shape) grid.shape = auto_shape(grid);
    return grid;
}

std::vector<VirtualRank> ranks_of(const SimulateCase& what, int count, int in_flight) {
    std::vector<VirtualRank> ranks;
    ranks.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        ranks.push_back({i == 0 && what.dedicated ? 0 : what.slots, in_flight,
                         what.speeds[static_cast<std::size_t>(i) % what.speeds.size()],
                         what.ranks_per_host > 0 ? i / what.ranks_per_host : 0});
    return ranks;
}

}  // namespace

bool SimulateCase::on(const std::string& name) const {
    const SimulateTerm* found = find(terms, name);
    return found != nullptr && found->on;
}

double SimulateCase::value(const std::string& name) const {
    return on(name) ? find(terms, name)->value : 0;
}

SimulateCase SimulateCase::without(const std::string& name) const {
    SimulateCase other = *this;
    switch_off(other.terms, name, "asked for");
    return other;
}

double SimulateCase::launch_cpu() const {
    return value(term::bare) + value(term::parse) + value(term::photons) + value(term::radiosity) +
           value(term::frame);
}

double SimulateCase::serial_seconds() const {
    if (against) return *against;
    double gathered = 0;
    for (const std::vector<double>& wave : waves)
        gathered += std::accumulate(wave.begin(), wave.end(), 0.0);
    return value(term::start) + value(term::end) + launch_cpu() + gathered + costs.cpu_seconds();
}

void set_term(std::vector<SimulateTerm>& terms, const std::string& name, double value,
              const std::string& why) {
    SimulateTerm& term = require(terms, name);
    term.value = value;
    term.on = true;
    term.why = why;
}

void switch_off(std::vector<SimulateTerm>& terms, const std::string& name, const std::string& why) {
    SimulateTerm& term = require(terms, name);
    term.on = false;
    term.why = why;
}

std::vector<Section> cut(const SimulateCase& what, int sections) {
    return make_partition(grid_of(what, sections)).sections;
}

long long most_sections(const SimulateCase& what) {
    GridRequest grid = what.grid;
    if (what.auto_shape) grid.shape = Shape::tiles;
    return max_sections(grid);
}

namespace {

// What sections of an image and of a wave have in common. `network` is without their bytes.
VirtualRun run_of(const SimulateCase& what, int ranks, std::vector<double> section_cpu,
                  int in_flight) {
    VirtualRun run;
    run.policy = what.policy;
    run.threads = what.threads;
    run.ranks = ranks_of(what, ranks, in_flight);
    run.section_cpu = std::move(section_cpu);
    if (!what.on(term::uneven) && !run.section_cpu.empty()) {
        const double mean = std::accumulate(run.section_cpu.begin(), run.section_cpu.end(), 0.0) /
                            static_cast<double>(run.section_cpu.size());
        std::fill(run.section_cpu.begin(), run.section_cpu.end(), mean);
    }
    run.launch = {what.value(term::start),
                  what.value(term::bare) + what.value(term::parse) + what.value(term::frame),
                  what.value(term::photons) + what.value(term::radiosity), what.value(term::end)};

    VirtualTerms& terms = run.terms;
    const auto given = [&](const char* name) {
        return what.on(name) ? std::optional(what.value(name)) : std::nullopt;
    };
    terms.answer_seconds = given(term::answer);
    terms.service_seconds = given(term::service);
    if (!what.dedicated) terms.rank0_cpu_seconds = given(term::rank0);
    if (what.on(term::latency) || what.on(term::bandwidth)) {
        VirtualNetwork network;
        network.latency = what.value(term::latency);
        if (what.on(term::bandwidth)) network.bytes_per_second = what.value(term::bandwidth);
        terms.network = std::move(network);
    }
    return run;
}

}  // namespace

double gathering_seconds(const SimulateCase& what, int ranks, int in_flight) {
    if (!what.on(term::gathering)) return 0;
    double sum = 0;
    for (const std::vector<double>& wave : what.waves)
        sum += run_virtually(run_of(what, ranks, wave, in_flight)).wall_seconds;
    return sum;
}

VirtualRun virtual_run(const SimulateCase& what, int ranks, const std::vector<Section>& sections,
                       int in_flight) {
    std::vector<double> section_cpu;
    section_cpu.reserve(sections.size());
    for (const Section& section : sections)
        section_cpu.push_back(what.costs.cpu_seconds(section.keep));
    VirtualRun run = run_of(what, ranks, std::move(section_cpu), in_flight);
    VirtualTerms& terms = run.terms;
    const double gathering = gathering_seconds(what, ranks, in_flight);
    if (what.on(term::before) || gathering > 0) terms.before = what.value(term::before) + gathering;
    if (what.on(term::after)) terms.after = what.value(term::after);
    terms.copies = what.on(term::copies);
    if (terms.network && what.on(term::bandwidth))
        for (const Section& section : sections)
            terms.network->section_bytes.push_back(static_cast<double>(section.render.area()) *
                                                   what.bytes_per_pixel);
    return run;
}

}  // namespace mpipov
