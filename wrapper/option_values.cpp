#include "option_values.h"

#include "failure.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace mpipov {
namespace {

[[noreturn]] void bad_value(const std::string& value, const char* wanted) {
    throw Failure(Exit::usage, fmt::format("'{}' is not {}", value, wanted));
}

}  // namespace

int whole(const std::string& value, int least, const char* wanted) {
    std::size_t used = 0;
    int number = 0;
    try {
        number = std::stoi(value, &used);
    } catch (const std::exception&) {
        bad_value(value, wanted);
    }
    if (used != value.size() || number < least) bad_value(value, wanted);
    return number;
}

std::optional<int> whole_or_auto(const std::string& value, const char* wanted) {
    if (value == "auto") return {};
    return whole(value, 1, wanted);
}

void set_seams(Options& o, const std::string& value) {
    if (value == "auto") {
        o.seams.reset();
        return;
    }
    for (const Seams seams : {Seams::aligned, Seams::halo, Seams::plain})
        if (value == to_string(seams)) {
            o.seams = seams;
            return;
        }
    if (value.rfind("halo:", 0) == 0) {
        o.seams = Seams::halo;
        o.halo = whole(value.substr(5), 1, "a halo: a whole number of pixels from 1");
        return;
    }
    bad_value(value, "one of auto, aligned, halo, halo:N, plain");
}

void set_shape(Options& o, const std::string& value) {
    if (value == "auto") {
        o.shape.reset();
        return;
    }
    for (const Shape shape : {Shape::columns, Shape::rows, Shape::tiles})
        if (value == to_string(shape)) {
            o.shape = shape;
            return;
        }
    bad_value(value, "one of auto, columns, rows, tiles");
}

void set_radiosity(Options& o, const std::string& value) {
    o.radiosity_passes = 1;
    if (value == "auto") {
        o.radiosity.reset();
        return;
    }
    const auto colon = value.find(':');
    for (const Sharing how : {Sharing::independent, Sharing::shared, Sharing::joined}) {
        if (value.substr(0, colon) != to_string(how)) continue;
        if (colon != std::string::npos) {
            if (how == Sharing::independent) break;
            constexpr int most_passes = 100;
            constexpr const char* wanted = "a number of passes: a whole number from 1 to 100";
            o.radiosity_passes = whole(value.substr(colon + 1), 1, wanted);
            if (o.radiosity_passes > most_passes) bad_value(value.substr(colon + 1), wanted);
        }
        o.radiosity = how;
        return;
    }
    bad_value(value, "one of auto, independent, shared, shared:PASSES, joined, joined:PASSES");
}

void set_schedule(Options& o, const std::string& value) {
    for (const Policy policy : {Policy::static_, Policy::dynamic, Policy::cost})
        if (value == to_string(policy)) {
            o.schedule = policy;
            return;
        }
    bad_value(value, "one of static, dynamic, cost");
}

void set_ship(Options& o, const std::string& value) {
    if (value == "auto")
        o.ship = Ship::automatic;
    else if (value == "on")
        o.ship = Ship::on;
    else if (value == "off")
        o.ship = Ship::off;
    else
        bad_value(value, "one of auto, on, off");
}

void set_progress(Options& o, const std::string& value) {
    if (value == "auto")
        o.progress = ProgressStyle::automatic;
    else if (value == "plain")
        o.progress = ProgressStyle::plain;
    else if (value == "none")
        o.progress = ProgressStyle::none;
    else
        bad_value(value, "one of auto, plain, none");
}

namespace {

// `wanted` finishes "'x' is not ...".
double positive_seconds(const std::string& value, const char* wanted) {
    std::size_t used = 0;
    double seconds = 0;
    try {
        seconds = std::stod(value, &used);
    } catch (const std::exception&) {
        bad_value(value, wanted);
    }
    if (used != value.size() || !(seconds > 0) || !std::isfinite(seconds)) bad_value(value, wanted);
    return seconds;
}

}  // namespace

void set_lost_after(Options& o, const std::string& value) {
    o.lost_after_seconds = positive_seconds(value, "a number of seconds");
}

void set_timeout(Options& o, const std::string& value) {
    o.timeout_seconds.reset();
    if (value != "auto") o.timeout_seconds = positive_seconds(value, "auto or a number of seconds");
}

}  // namespace mpipov
