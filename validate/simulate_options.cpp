#include "simulate_options.h"

#include "failure.h"
#include "render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace mpipov {
namespace {

[[noreturn]] void refuse(const std::string& why) {
    throw Failure(Exit::usage, why);
}

double number(const std::string& option, const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value) || value <= 0)
        refuse(fmt::format("{}: '{}' is no number above 0", option, text));
    return value;
}

// "640x480"
Rect image_of(const std::string& text) {
    const std::size_t by = text.find('x');
    if (by == std::string::npos) refuse(fmt::format("--size: '{}' is no size like 640x480", text));
    return {0, 0, split_numbers("--size", text.substr(0, by)).front(),
            split_numbers("--size", text.substr(by + 1)).front()};
}

template <class Enum>
Enum one_of(const std::string& option, const std::string& text, const std::vector<Enum>& values) {
    for (const Enum value : values)
        if (to_string(value) == text) return value;
    refuse(fmt::format("{}: '{}' is no such {}", option, text, option.substr(2)));
}

SimulateCase case_of_record(const std::string& file) {
    try {
        return case_of_run(read_run_record(file));
    } catch (const std::invalid_argument& error) {
        throw Failure(Exit::file, fmt::format("'{}': {}", file, error.what()));
    } catch (const std::runtime_error& error) {
        throw Failure(Exit::file, error.what());
    }
}

SimulateCase case_of_image(const Rect& image) {
    SimulateCase what;
    what.width = image.width();
    what.height = image.height();
    what.grid.region = image;
    what.grid.seams = Seams::aligned;
    what.terms = default_terms(what.width, what.height);
    return what;
}

SimulateCase case_of_map(const std::string& file) {
    try {
        const CostMap costs = read_cost_map(file);
        SimulateCase what = case_of_image(costs.region());
        what.costs = costs;
        what.costs_from = fmt::format("the map '{}'", file);
        return what;
    } catch (const std::runtime_error& error) {
        throw Failure(Exit::file, error.what());
    }
}

// All but the costs, which follow from the serial render's time once the terms are known.
SimulateCase case_of_serial(const SimulateOptions& options) {
    if (options.size.empty()) refuse("--serial-seconds needs --size WxH");
    return case_of_image(image_of(options.size));
}

void trace_for(SimulateCase& what, const SimulateOptions& options) {
    // The paper's serial render starts no other program: all of its time is tracing.
    const double other = options.paper ? 0 : what.serial_seconds();
    const double trace = *options.serial_seconds - other;
    if (trace < 0)
        refuse(fmt::format("--serial-seconds {:.4g}: a launch takes {:.4g} s without any tracing",
                           *options.serial_seconds, other));
    const bool hill = options.map == "hill";
    what.costs =
        hill ? hill_costs(what.grid.region, trace) : uniform_costs(what.grid.region, trace);
    what.costs_from = hill ? "a made-up hill" : "spread evenly over the image";
}

void take_terms(SimulateCase& what, const SimulateOptions& options) {
    for (const auto& [name, value] : options.values) set_term(what.terms, name, value, "given");
    if (options.coordinator_rate)
        for (const char* name : {term::service, term::rank0})
            set_term(what.terms, name, 1 / *options.coordinator_rate, "given");
    if (options.ranks_per_host > 0)
        for (const char* name : {term::latency, term::bandwidth})
            if (!options.values.contains(name))
                set_term(what.terms, name, name == term::latency ? 50e-6 : 125e6,
                         "more than one host; Gigabit Ethernet");
    if (options.dedicated)
        switch_off(what.terms, term::rank0, "rank 0 renders nothing (--dedicated-coordinator)");
    if (what.policy == Policy::static_)
        switch_off(what.terms, term::copies, "never with --schedule static");
    for (const std::string& name : options.without) {
        try {
            switch_off(what.terms, name, "asked for (--without)");
        } catch (const std::logic_error&) {
            std::string names;
            for (const SimulateTerm& one : what.terms)
                names += (names.empty() ? "'" : ", '") + one.name + "'";
            refuse(fmt::format("--without '{}': the terms are {}", name, names));
        }
    }
}

void take_grid(SimulateCase& what, const SimulateOptions& options) {
    what.policy = one_of("--schedule", options.schedule, schedules);
    if (!options.seams.empty()) {
        what.grid.seams =
            one_of("--seams", options.seams, std::vector{Seams::aligned, Seams::plain});
        what.grid.halo = 0;
    }
    what.auto_shape = options.shape == "auto";
    if (!what.auto_shape)
        what.grid.shape = one_of("--shape", options.shape,
                                 std::vector{Shape::columns, Shape::rows, Shape::tiles});
    if (options.sections) what.sections = options.sections;
    what.in_flight = options.in_flight;
    if (options.threads) what.threads = *options.threads;
    what.slots = options.slots;
    what.speeds.clear();
    for (const std::string& speed : split_list("--speeds", options.speeds))
        what.speeds.push_back(number("--speeds", speed));
    what.ranks_per_host = options.ranks_per_host;
    what.dedicated = options.dedicated;
    if (what.sections && *what.sections > most_sections(what))
        refuse(fmt::format("--sections {}: this grid holds {} at most", *what.sections,
                           most_sections(what)));
}

}  // namespace

SimulateCase simulate_case(const SimulateOptions& options) {
    const int given = static_cast<int>(!options.run.empty()) +
                      static_cast<int>(!options.costs.empty()) +
                      static_cast<int>(options.serial_seconds.has_value());
    if (given != 1)
        refuse("where does tracing cost what? Give one of --run, --costs and --serial-seconds");
    SimulateCase what = !options.run.empty()     ? case_of_record(options.run)
                        : !options.costs.empty() ? case_of_map(options.costs)
                                                 : case_of_serial(options);
    take_grid(what, options);
    take_terms(what, options);
    if (options.serial_seconds) trace_for(what, options);
    what.against = options.against;
    return what;
}

std::vector<int> simulate_ranks(const SimulateOptions& options) {
    std::vector<int> ranks =
        split_numbers("--ranks", options.ranks.empty() ? options.paper ? "1,2,4,8" : "1,2,4,8,16"
                                                       : options.ranks);
    for (const int count : ranks)
        if (count > 1 << 20) refuse(fmt::format("--ranks: {} are more than a million", count));
    return ranks;
}

std::vector<SimulateBar> simulate_bars(const SimulateOptions& options) {
    const std::vector<int> ranks = simulate_ranks(options);
    std::vector<SimulateBar> bars;
    for (const std::string& text : options.bars) {
        const std::size_t colon = text.find(':');
        if (colon == std::string::npos)
            refuse(fmt::format("--bar: '{}' is no RANKS:EFFICIENCY like 64:0.95", text));
        const int count = split_numbers("--bar", text.substr(0, colon)).front();
        if (std::find(ranks.begin(), ranks.end(), count) == ranks.end())
            refuse(fmt::format("--bar {}: --ranks has no {}", text, count));
        bars.push_back({count, number("--bar", text.substr(colon + 1))});
    }
    return bars;
}

}  // namespace mpipov
