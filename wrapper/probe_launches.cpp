#include "probe_launches.h"

#include "cache_stream.h"
#include "failure.h"
#include "interrupt.h"
#include "launch_failure.h"
#include "povray_text.h"
#include "probe.h"
#include "worker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <regex>
#include <utility>

namespace mpipov {
namespace {

constexpr const char* image_name = "probe";
constexpr const char* resolve_name = "resolve";
constexpr const char* stop_text = "mpipov has seen what it needs";
// The small render's longest side: large enough to meet what is in the picture, small enough to
// cost about half a percent of it.
constexpr int smallest_side = 32, largest_side = 128, side_ratio = 16;
// Small blocks, so that there are many whose order can differ.
constexpr int probe_block = 8;
// Measured with a jittered light whose soft shadow falls into one small corner, at 32x24 to 80x60:
// +RP2 and +RP4 change its pixels at every size, +RP1 and +RP5 at most, +RP3 at none.
// One block's random numbers come out the same in every order of blocks, so the blocks are of other
// sizes too: in one order a crand ball within one block of 8 was not found up to 25 % of the width.
struct Order {
    int number, block;
};
constexpr std::size_t first_other_order = 3;  // of the launches
constexpr std::array other_orders{Order{2, 7}, Order{5, 4}};

// The number in +W640 or Width=640.
int side_from_arguments(const std::vector<std::string>& arguments, const std::string& letter,
                        const std::string& key, int fallback) {
    const std::regex shape(fmt::format(R"(^(?:[+-]{}|{}=)(\d+)$)", letter, key), std::regex::icase);
    int side = fallback;
    for (const std::string& argument : arguments) {
        std::smatch match;
        if (!std::regex_match(argument, match, shape)) continue;
        const std::string digits = match[1];
        int value = 0;
        if (std::from_chars(digits.data(), digits.data() + digits.size(), value).ec ==
                std::errc() &&
            value > 0)
            side = value;
    }
    return side;
}

// POV-Ray breaks lines anywhere, so the text is looked for without its line feeds.
bool met_our_header(std::string_view text) {
    std::string joined(text);
    joined.erase(std::remove(joined.begin(), joined.end(), '\n'), joined.end());
    return joined.find(stop_text) != std::string::npos;
}

}  // namespace

ProbeView small_view(const std::vector<std::string>& arguments) {
    const int width = side_from_arguments(arguments, "W", "Width", 800);
    const int height = side_from_arguments(arguments, "H", "Height", 600);
    const int longest = std::max(width, height);
    const double scale =
        static_cast<double>(std::clamp(longest / side_ratio, smallest_side, largest_side)) /
        longest;
    return {{std::max(2, static_cast<int>(width * scale)),
             std::max(2, static_cast<int>(height * scale))},
            {}};
}

ProbeView middle_view(const ImageSize& image) {
    const auto middle = [](int size) {
        const int part = std::min(size, std::clamp(size / side_ratio, smallest_side, largest_side));
        return std::pair{(size - part) / 2, (size + part) / 2};
    };
    const auto [x0, x1] = middle(image.width);
    const auto [y0, y1] = middle(image.height);
    return {image, launch_area({x0, y0, x1, y1}, image)};
}

std::vector<std::string> view_arguments(const ProbeView& view, bool plain) {
    std::vector<std::string> arguments = {fmt::format("+W{}", view.size.width),
                                          fmt::format("+H{}", view.size.height),
                                          fmt::format("+BS{}", probe_block), "Create_Ini=",
                                          // A user's cache is not for samples of a small picture.
                                          "-RFO"};
    // Never as the user's own +SC, +EC, +SR, +ER would have it.
    const auto area = view.area.empty() ? std::vector<std::string>{"+SC0", "+EC1", "+SR0", "+ER1"}
                                        : area_arguments(view.area);
    arguments.insert(arguments.end(), area.begin(), area.end());
    if (plain) arguments.emplace_back("-A");
    return arguments;
}

std::vector<std::string> small_command(const ProbeRequest& request,
                                       const std::vector<std::string>& more) {
    std::vector<std::string> argv{request.povray};
    for (const auto* list : {&request.user_arguments, &more})
        argv.insert(argv.end(), list->begin(), list->end());
    for (const char* ours : {"-D", "-P", "-C", "+V", "+WT1", "All_Console=on"})
        argv.emplace_back(ours);
    return argv;
}

std::filesystem::path small_image(const std::filesystem::path& folder) {
    return folder / image_name;
}

double small_timeout(const ProbeRequest& request) {
    constexpr double seconds = 3600;
    return request.timeout_seconds.value_or(seconds);
}

ChildRequest small_request(const ProbeRequest& request, const std::filesystem::path& folder,
                           std::vector<std::string> argv, std::optional<std::uint64_t> pixels) {
    LaunchNeeds needs{std::move(argv), folder, small_timeout(request)};
    needs.pixels = pixels;
    return request.confinement.request(std::move(needs));
}

ProbeLaunches::ProbeLaunches(const ProbeRequest& request) : request_(request) {
    const std::filesystem::path folder = request.scratch / resolve_name;
    std::filesystem::create_directories(folder);
    const std::filesystem::path header = folder / "stop.inc";
    std::ofstream(header) << "#error \"" << stop_text << "\"\n";
    start(resolve_name, {fmt::format("+HI\"{}\"", header.string()),
                         fmt::format("+GI\"{}\"", settings_file().string())});
}

void ProbeLaunches::render(const ProbeView& view) {
    for (std::size_t i = 1; i < launches_.size(); ++i)
        earlier_cpu_seconds_ += launches_[i].child.cpu_seconds();
    launches_.erase(std::next(launches_.begin()), launches_.end());
    const int number = ++views_;
    pixels_ =
        static_cast<std::uint64_t>(view.size.width) * static_cast<std::uint64_t>(view.size.height);
    start(fmt::format("render{}", number), view_arguments(view, false));
    // Antialiasing of method 1 depends on where blocks end, and has no random numbers of its own.
    const std::vector<std::string> arguments = view_arguments(view, true);
    const std::string first = fmt::format("render{}-order0", number);
    cache_ = request_.scratch / first / "radiosity";
    // Not what a user's own cache holds: these samples are a coarse pass for sections to share.
    start(first, arguments, {"-RFI", "+RFO", fmt::format("+RF\"{}\"", cache_.string())});
    for (const Order& order : other_orders) {
        std::vector<std::string> other_order = arguments;
        other_order.push_back(fmt::format("+BS{}", order.block));
        other_order.push_back(fmt::format("+RP{}", order.number));
        start(fmt::format("render{}-order{}", number, order.number), other_order);
    }
}

void ProbeLaunches::wait() {
    for (;;) {
        throw_if_interrupted();
        ShortLaunch& resolve = launches_.front();
        // It is of no more use once it has met our header.
        if (!resolve.over() && !resolve.child.poll() && met_our_header(resolve.child.output())) {
            resolve.child.kill_now();
            resolve.enough = true;
        }
        if (takes_radiosity_samples()) end_other_orders();
        bool running = !resolve.over();
        for (std::size_t i = 1; i < launches_.size(); ++i) {
            const bool over = launches_[i].poll();
            running = running || !over;
        }
        if (!running) return;
        if (resolve.over() && !resolved()) return;
        if (resolve.over() && launches_.size() > 1 && launches_[1].over() && !rendered()) return;
        sleep_on(launches_);
    }
}

// POV-Ray makes the file at once and writes to it while it renders.
bool ProbeLaunches::takes_radiosity_samples() const {
    std::error_code none;
    const auto size = std::filesystem::file_size(cache_, none);
    return !none && size > 0;
}

void ProbeLaunches::end_other_orders() {
    if (!radiosity_told_ && request_.at_radiosity) request_.at_radiosity();
    radiosity_told_ = true;
    for (std::size_t i = first_other_order; i < launches_.size(); ++i) {
        if (launches_[i].over()) continue;
        launches_[i].child.kill_now();
        launches_[i].enough = true;
    }
}

bool ProbeLaunches::resolved() const {
    return met_our_header(resolve_output());
}

bool ProbeLaunches::started() const {
    const ChildProcess& resolve = launches_.front().child;
    return !resolve.ended() || resolve.result().exit_code != 127;
}

std::filesystem::path ProbeLaunches::settings_file() const {
    return request_.scratch / resolve_name / "settings.ini";
}

bool ProbeLaunches::refused_by_the_scene() const {
    return !rendered() && render_output().find("Fatal error in parser") != std::string_view::npos;
}

std::filesystem::path ProbeLaunches::sample() const {
    return image_of(launches_.at(1));
}

std::vector<std::filesystem::path> ProbeLaunches::in_several_orders() const {
    std::vector<std::filesystem::path> images;
    const bool radiosity = takes_radiosity_samples();
    const std::size_t end = radiosity ? first_other_order : launches_.size();
    for (std::size_t i = 2; i < end; ++i) images.push_back(image_of(launches_[i]));
    return images;
}

std::string ProbeLaunches::radiosity_cache() const {
    return read_new_samples(cache_, 0, radiosity_samples(plain_output()));
}

double ProbeLaunches::cpu_seconds() const {
    double sum = earlier_cpu_seconds_;
    for (const ShortLaunch& launch : launches_) sum += launch.child.cpu_seconds();
    return sum;
}

void ProbeLaunches::start(const std::string& name, const std::vector<std::string>& more,
                          const std::vector<std::string>& last) {
    const std::filesystem::path folder = request_.scratch / name;
    std::filesystem::create_directory(folder);
    std::vector<std::string> argv = small_command(request_, more);
    argv.insert(argv.end(), last.begin(), last.end());
    // The first launch is asked for the user's own output file; it never comes to write one.
    if (!launches_.empty()) argv.push_back(fmt::format("+O\"{}\"", small_image(folder).string()));
    launches_.push_back(ShortLaunch::start(
        small_request(request_, folder, std::move(argv), pixels_), small_image(folder)));
    ++started_;
}

std::filesystem::path ProbeLaunches::image_of(const ShortLaunch& launch) const {
    if (!launch.succeeded()) {
        const LaunchFailure failure = launch_failure(
            launch.child, request_.confinement, {launch.base.parent_path(), frame_bytes(0, 0)});
        throw Failure(failure.code, failure.why);
    }
    return find_image(launch.base);
}

}  // namespace mpipov
