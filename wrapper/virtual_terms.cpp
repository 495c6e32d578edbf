// What a virtual run may be asked, and how its terms are called.
#include "virtual_run.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mpipov {
namespace {

void require(bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
}

// Beyond that the clock, a double, would stand still: and 1e15 s are thirty million years.
constexpr double longest_seconds = 1e15;

bool sane(double seconds) {
    return seconds >= 0 && seconds <= longest_seconds;
}

}  // namespace

void check(const VirtualRun& run) {
    const VirtualTerms& terms = run.terms;
    const LaunchPhases& launch = run.launch;
    for (const double seconds :
         {launch.idle_before, launch.serial_cpu, launch.parallel_cpu, launch.idle_after,
          terms.answer_seconds.value_or(0), terms.service_seconds.value_or(0),
          terms.rank0_cpu_seconds.value_or(0), terms.before.value_or(0), terms.after.value_or(0),
          terms.network ? terms.network->latency : 0})
        require(sane(seconds), "a time is negative, no number or longer than 1e15 s");
    require(std::ranges::all_of(run.section_cpu, sane),
            "a section's cost is negative, no number or more than 1e15 s");
    require(run.threads >= 1, "a launch has at least one thread");
    for (const VirtualRank& rank : run.ranks)
        require(rank.slots >= 0 && rank.in_flight >= 1 && sane(rank.speed) && rank.speed > 0,
                "a rank has at least one launch under way, and a speed above 0");
    if (terms.network) {
        require(terms.network->bytes_per_second > 0, "a bandwidth is above 0");
        require(terms.network->section_bytes.empty() ||
                    terms.network->section_bytes.size() == run.section_cpu.size(),
                "each section has its bytes");
        require(std::ranges::all_of(terms.network->section_bytes, sane),
                "a section has less than no bytes, or too many");
    }
}

std::vector<std::string_view> terms_on(const VirtualTerms& terms) {
    std::vector<std::string_view> on;
    if (terms.answer_seconds) on.emplace_back("answer");
    if (terms.service_seconds) on.emplace_back("service");
    if (terms.rank0_cpu_seconds) on.emplace_back("rank0");
    if (terms.network) on.emplace_back("network");
    if (terms.before) on.emplace_back("before");
    if (terms.after) on.emplace_back("after");
    if (terms.copies) on.emplace_back("copies");
    return on;
}

}  // namespace mpipov
