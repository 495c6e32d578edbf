// The terms as laws: how good a run can be at most because of one of them, whatever the grid.
#include "simulate_sweep.h"

#include <fmt/format.h>

namespace mpipov {
namespace {

// Of a run in which every core, for the whole of its share, must also wait for or do `seconds`.
std::string at_most(const SimulateCase& what, const SimulateRow& row, double seconds) {
    const double share = what.costs.cpu_seconds() / row.power;
    return fmt::format(
        "efficiency <= {:.3g} s of tracing for each core / ({:.3g} + {:.3g} s) = "
        "{:.3f}",
        share, share, seconds, share / (share + seconds));
}

bool is_serial(const std::string& name) {
    return name == term::bare || name == term::parse || name == term::frame;
}

bool is_parallel(const std::string& name) {
    return name == term::photons || name == term::radiosity;
}

}  // namespace

std::string law_of(const SimulateCase& what, const SimulateRow& row) {
    const std::string& name = row.bound_by;
    const double value = what.value(name);
    if (is_serial(name))
        return fmt::format(
            "every launch pays for the {} again, and each core has a launch at least: {}. {}", name,
            at_most(what, row, value),
            what.threads == 1 ? "Lifted by longer work for each core."
                              : "One thread does it, and the launch's other cores wait unless "
                                "another launch fills them.");
    if (is_parallel(name))
        return fmt::format(
            "every launch pays for the {} again, and there is one at least for each {}: {}. Lifted "
            "by ranks of more cores with more threads a launch (--slots, --threads).",
            name, what.threads > 1 ? fmt::format("{} cores", what.threads) : "core",
            at_most(what, row, value / what.threads));
    if (name == term::start || name == term::end)
        return fmt::format(
            "a core has nothing to do while its first launch starts: {}. Lifted only by longer "
            "work for each core; later launches hide it (--in-flight).",
            at_most(what, row, value));
    if (name == term::before || name == term::after)
        return fmt::format(
            "all cores wait {} the sections (Amdahl): {}. Lifted by longer work "
            "for each core.",
            name, at_most(what, row, value));
    if (name == term::gathering)
        return fmt::format(
            "radiosity samples are gathered before the image, {:.4g} CPU s in {} waves, each of "
            "which waits for the last of its sections. Lifted by --radiosity independent, whose "
            "seams show, or by more sections.",
            value, what.waves.size());
    if (name == term::service)
        return fmt::format(
            "rank 0 handles at most {:.4g} sections a second and is asked for "
            "{:.4g}. Lifted by fewer, longer sections.",
            1 / value, row.handled_by_second);
    if (name == term::rank0)
        return "rank 0's core coordinates instead of rendering. Lifted by --dedicated-coordinator "
               "or fewer sections.";
    if (name == term::answer)
        return "lanes wait for rank 0's answers. Lifted by --in-flight and longer sections.";
    if (name == term::latency || name == term::bandwidth)
        return "the network: pixels and messages on their way. Lifted by a faster one, or by "
               "longer sections.";
    if (name == term::uneven)
        return "sections do not cost the same, and the run ends with its last one. Lifted by "
               "--schedule cost and more sections.";
    return "nothing but its cores.";
}

}  // namespace mpipov
