#include "progress.h"

#include "printable.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mpipov {
namespace {

constexpr double live_interval = 0.2;    // seconds between two looks of a live line
constexpr double plain_interval = 10.0;  // between two plain lines
constexpr double plain_step = 0.1;       // or this much progress, whichever comes first
constexpr double shortest_estimate = 1.0;
constexpr double longest_estimate = 1e9;  // seconds; who knows more than thirty years ahead

std::string duration(double seconds) {
    const auto all = static_cast<long long>(std::llround(seconds));
    if (all < 60) return fmt::format("{} s", all);
    if (all < 3600) return fmt::format("{} min {:02} s", all / 60, all % 60);
    return fmt::format("{} h {:02} min", all / 3600, all / 60 % 60);
}

}  // namespace

std::string progress_line(double fraction, int sections_done, int sections, double seconds) {
    // The pixels of a section are done before it has come in.
    const double most = sections_done < sections ? 99 : 100;
    std::string line =
        fmt::format("{:.0f} %, {} of {} sections", std::min(std::floor(fraction * 100), most),
                    sections_done, sections);
    if (fraction > 0 && fraction < 1 && seconds > shortest_estimate) {
        const double left = seconds * (1 - fraction) / fraction;
        if (left < longest_estimate) line += fmt::format(", {} left", duration(left));
    }
    return line;
}

void ProgressView::print(const std::string& text) {
    // Nobody may listen any more (a closed pipe), which is no reason to stop.
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

ProgressView::ProgressView(ProgressStyle style)
    : style_(style), live_(style == ProgressStyle::automatic && isatty(STDERR_FILENO) == 1) {}

ProgressView::~ProgressView() {
    clear();
}

void ProgressView::clear() {
    if (!shown_) return;
    print("\r\x1b[K");
    shown_ = false;
}

void ProgressView::update(double fraction, int sections_done, int sections, double seconds) {
    show(fraction, seconds,
         [&] { return progress_line(fraction, sections_done, sections, seconds - began_); });
}

void ProgressView::update_gathering(int wave, int waves, double fraction, double seconds) {
    show(wave - 1 + fraction, seconds, [&] {
        return fmt::format("radiosity samples, {:.0f} % of wave {} of {}",
                           std::floor(fraction * 100), wave, waves);
    });
}

// `fraction` only says when a line is due; that of the image begins anew after the waves.
void ProgressView::show(double fraction, double seconds,
                        const std::function<std::string()>& line_of) {
    if (style_ == ProgressStyle::none) return;
    // A clock that went back must not silence it.
    if (seconds < last_update_) last_update_ = seconds;
    const bool due =
        live_ ? seconds - last_update_ >= live_interval
              : fraction != last_fraction_ && (seconds - last_update_ >= plain_interval ||
                                               std::abs(fraction - last_fraction_) >= plain_step);
    if (!due) return;
    last_update_ = seconds;
    last_fraction_ = fraction;
    const std::string line = line_of();
    if (live_) {
        print(fmt::format("\r{}\x1b[K", line));
        shown_ = true;
    } else {
        print(fmt::format("mpipov: {}\n", line));
    }
}

void ProgressView::finish(int sections, double seconds) {
    if (style_ == ProgressStyle::none || live_) return;
    print(fmt::format("mpipov: {} in {}\n", progress_line(1, sections, sections, seconds),
                      duration(seconds)));
}

void ProgressView::say(const std::string& line) {
    clear();
    print(printable(line) + '\n');
}

void ProgressView::inform(const std::string& line) {
    if (style_ != ProgressStyle::none) say(line);
}

}  // namespace mpipov
