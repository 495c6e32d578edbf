#include "quality_look.h"

#include "cost_model.h"
#include "launch_costs.h"
#include "probe_launches.h"
#include "short_launch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace mpipov {
namespace {

// Seconds of tracing that POV-Ray's clock, which shows milliseconds, tells to a percent.
constexpr double readable_seconds = 0.1;
// What a render takes that its clock does not show at all.
constexpr double unseen_seconds = 0.0005;
constexpr double most_scale = 8, least_scale = 0.5;
// Of gathering radiosity before it, which is done again and not what is looked for.
constexpr double most_gathering_seconds = 1;
constexpr double noticed_share = 0.01;

ProbeView view_of(const ProbeRequest& request, const ProbeResult& probe, double scale) {
    if (!probe.seen_whole) return middle_view({probe.image.width, probe.image.height});
    ProbeView view = small_view(request.user_arguments);
    view.size.width = std::max(2, static_cast<int>(view.size.width * scale));
    view.size.height = std::max(2, static_cast<int>(view.size.height * scale));
    return view;
}

long long pixels_of(const ProbeView& view) {
    return view.area.empty() ? static_cast<long long>(view.size.width) * view.size.height
                             : view.area.area();
}

class QualityLaunches {
  public:
    QualityLaunches(const ProbeRequest& request, const ProbeView& view)
        : request_(request),
          pixels_(static_cast<std::uint64_t>(view.size.width) *
                  static_cast<std::uint64_t>(view.size.height)) {}

    void start(const std::string& name, std::vector<std::string> more) {
        const std::filesystem::path folder = request_.scratch / name;
        std::filesystem::create_directories(folder);
        const std::filesystem::path image = small_image(folder);
        more.push_back(fmt::format("+O\"{}\"", image.string()));
        launches_.push_back(ShortLaunch::start(
            small_request(request_, folder, small_command(request_, more), pixels_), image));
    }

    void wait() { wait_for_all(launches_); }

    bool all_succeeded() const {
        return std::all_of(launches_.begin(), launches_.end(),
                           [](const ShortLaunch& launch) { return launch.succeeded(); });
    }
    LaunchReport report(std::size_t index) const {
        return parse_report(launches_.at(index).child.output());
    }
    double cpu_seconds() const {
        double sum = 0;
        for (const ShortLaunch& launch : launches_) sum += launch.child.cpu_seconds();
        return sum;
    }
    int count() const { return static_cast<int>(launches_.size()); }

  private:
    const ProbeRequest& request_;
    std::uint64_t pixels_;
    std::vector<ShortLaunch> launches_;
};

}  // namespace

std::vector<int> levels_below(int quality) {
    std::vector<int> levels;
    for (const int level : {4, 5, 6, 8})
        if (level < quality) levels.push_back(level);
    return levels;
}

double readable_scale(const ProbeResult& given, const ImageSize& probe_size) {
    const ProbeResult probe = with_sane_times(given);
    const double tracing = std::max(unseen_seconds, probe.plain.trace_cpu);
    const double gathering = std::max(unseen_seconds, probe.plain.radiosity_cpu);
    const double whole = std::min(probe.image.width / static_cast<double>(probe_size.width),
                                  probe.image.height / static_cast<double>(probe_size.height));
    const double scale =
        std::min({std::sqrt(readable_seconds / tracing),
                  std::sqrt(most_gathering_seconds / gathering), whole, most_scale});
    return std::max(1.0, scale);
}

std::optional<double> unnoticed_scale(const ProbeResult& given, double wall_seconds, int cores) {
    const ProbeResult probe = with_sane_times(given);
    const auto levels = static_cast<double>(levels_below(probe.quality).size());
    if (levels < 1) return 1;  // nothing is launched
    const auto wall = [&](double launches, double scale) {
        // Those below the user's own quality trace no more than it does.
        const double each = bare_launch_cpu_seconds + probe.report.parse_cpu +
                            probe.plain.trace_cpu * scale * scale;
        return startup_wall_seconds +
               launches * each / std::clamp(static_cast<double>(cores), 1.0, launches);
    };
    if (wall(levels, 1) <= noticed_share * wall_seconds) return 1;
    // The user's own quality is asked for again, with its photons and radiosity.
    const double before = probe.plain.photon_cpu + probe.plain.radiosity_cpu;
    const bool fits = wall(levels + 1, least_scale) + before <= noticed_share * wall_seconds;
    return probe.seen_whole && fits ? std::optional(least_scale) : std::nullopt;
}

LookedAt look_at_qualities(const ProbeRequest& request, const ProbeResult& probe, double scale) {
    const ProbeView view = view_of(request, probe, scale);
    const bool as_probe = pixels_of(view) == probe.probe_pixels;
    const bool larger = pixels_of(view) > probe.probe_pixels;
    const std::vector<int> levels = levels_below(probe.quality);
    const std::vector<std::string> plain = view_arguments(view, true);
    QualityLaunches launches(request, view);
    for (const int level : levels) {
        std::vector<std::string> arguments = plain;
        arguments.push_back(fmt::format("+Q{}", level));
        launches.start(fmt::format("quality{}", level), arguments);
    }
    if (!as_probe) launches.start("quality-all", plain);
    if (larger) launches.start("quality-report", view_arguments(view, false));
    launches.wait();
    LookedAt result{{}, launches.cpu_seconds(), launches.count()};
    if (!launches.all_succeeded()) return result;

    QualityLook look{pixels_of(view), {}, {}};
    for (std::size_t i = 0; i < levels.size(); ++i) look.plain[levels[i]] = launches.report(i);
    look.plain[probe.quality] = as_probe ? probe.plain : launches.report(levels.size());
    if (larger) look.report = launches.report(levels.size() + 1);
    result.look = std::move(look);
    return result;
}

}  // namespace mpipov
