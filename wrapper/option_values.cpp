#include "option_values.h"

#include "failure.h"
#include "printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace mpipov {
namespace {

[[noreturn]] void bad_value(const std::string& value, const char* wanted) {
    throw Failure(Exit::usage, fmt::format("'{}' is not {}", value, wanted));
}

// The word's value; the words are named where it is none of them.
template <class T>
T one_of(const std::string& word, std::initializer_list<std::pair<const char*, T>> choices) {
    std::vector<const char*> words;
    for (const auto& [name, value] : choices) {
        if (word == name) return value;
        words.push_back(name);
    }
    bad_value(word, fmt::format("one of {}", fmt::join(words, ", ")).c_str());
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
    o.schedule = one_of<Policy>(
        value, {{"static", Policy::static_}, {"dynamic", Policy::dynamic}, {"cost", Policy::cost}});
}

void set_ship(Options& o, const std::string& value) {
    o.ship = one_of<Ship>(value, {{"auto", Ship::automatic}, {"on", Ship::on}, {"off", Ship::off}});
}

void set_progress(Options& o, const std::string& value) {
    o.progress = one_of<ProgressStyle>(value, {{"auto", ProgressStyle::automatic},
                                               {"plain", ProgressStyle::plain},
                                               {"none", ProgressStyle::none}});
}

namespace {

struct Number {
    double value = 0;
    std::size_t used = 0;  // characters
};

// `wanted` finishes "'x' is not ...".
Number number_at_front(const std::string& text, const char* wanted) {
    Number number;
    try {
        number.value = std::stod(text, &number.used);
    } catch (const std::exception&) {
        bad_value(text, wanted);
    }
    return number;
}

double positive_seconds(const std::string& value, const char* wanted) {
    const auto [seconds, used] = number_at_front(value, wanted);
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

void set_confine(Options& o, const std::string& value) {
    o.confine = one_of<Confining>(
        value, {{"auto", Confining::automatic}, {"on", Confining::on}, {"off", Confining::off}});
}

SizeLimit size_limit(const std::string& value) {
    constexpr const char* wanted =
        "auto, none or a size such as 512M or 1.5G, from 1 byte to 1024T";
    constexpr double most = 1024.0 * 1024 * 1024 * 1024 * 1024;
    if (value == "auto") return {};
    if (value == "none") return {false, {}};
    constexpr std::string_view units = "KMGT";
    auto [bytes, used] = number_at_front(value, wanted);
    if (used < value.size()) {
        const auto unit =
            units.find(static_cast<char>(std::toupper(static_cast<unsigned char>(value[used]))));
        if (unit == std::string_view::npos || used + 1 != value.size()) bad_value(value, wanted);
        bytes *= std::pow(1024.0, static_cast<double>(unit + 1));
    }
    if (!(bytes >= 1 && bytes <= most)) bad_value(value, wanted);
    return {false, static_cast<std::uint64_t>(bytes)};
}

void require_passable(const std::vector<std::string>& povray_arguments) {
    for (const std::string& argument : povray_arguments) {
        if (argument.empty()) throw Failure(Exit::usage, "one of POV-Ray's arguments is empty");
        const auto control = std::ranges::find_if(
            argument, [](unsigned char c) { return (c < 0x20 && c != '\t') || c == 0x7f; });
        if (control == argument.end()) continue;
        std::string shown = printable(argument);
        std::ranges::replace(shown, '\n', '?');
        const char* what =
            *control == '\n' || *control == '\r' ? "line break" : "control character";
        throw Failure(Exit::usage, fmt::format("there is a {} in the argument '{}': POV-Ray is not "
                                               "given such names; rename the file",
                                               what, shown));
    }
}

}  // namespace mpipov
