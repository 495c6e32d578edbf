#include "cost_source.h"

#include "cost_model.h"
#include "probe_launches.h"
#include "run_record.h"
#include "short_launch.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <span>
#include <utility>
#include <vector>

namespace mpipov {
namespace {

// Of the small picture: enough to find a corner that costs all, few enough launches to pay.
constexpr int across = 4, down = 4;
// POV-Ray idles for most of such a launch.
constexpr std::size_t side_by_side = 8;
// What its clock cannot show: no part is free.
constexpr double least_cpu = 0.002;

struct Part {
    Rect rect;
    double cpu_seconds = least_cpu;
    bool failed = false;
};

bool cheaper(const Part& a, const Part& b) {
    return a.cpu_seconds < b.cpu_seconds;
}

std::vector<Part> parts_of(const ImageSize& size) {
    std::vector<Part> parts;
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i) {
            const Rect rect{size.width * i / across, size.height * j / down,
                            size.width * (i + 1) / across, size.height * (j + 1) / down};
            if (!rect.empty()) parts.push_back({rect});
        }
    return parts;
}

ShortLaunch launch(const ProbeRequest& request, const ImageSize& size, const Rect& rect,
                   const std::filesystem::path& base) {
    JobCommand job{request.povray, request.user_arguments, {}, 1, 0};
    job.user_arguments.push_back(fmt::format("+W{}", size.width));
    job.user_arguments.push_back(fmt::format("+H{}", size.height));
    return ShortLaunch::start(
        request.confinement.request(
            {section_command(job, rect, size, base), base.parent_path(), small_timeout(request)}),
        base);
}

}  // namespace

std::optional<CostMap> costs_of_earlier_run(const std::filesystem::path& file,
                                            const std::string& scene_sha1,
                                            const ProbeResult& probe) {
    try {
        // Not from a pipe, which we are to write into.
        if (!std::filesystem::is_regular_file(file)) return {};
        const RunRecord record = read_run_record(file);
        const Rect whole{0, 0, record.plan.image.width, record.plan.image.height};
        const Rect now{0, 0, probe.image.width, probe.image.height};
        const bool comparable = record.plan.region == probe.image.region ||
                                (record.plan.region == whole && probe.image.region == now);
        if (!record.complete || record.scene_sha1 != scene_sha1 || !comparable) return {};
        // A preview may have been rendered with other options: only the shape of its costs counts.
        ProbeResult of_record = probe;
        of_record.image.width = record.plan.image.width;
        of_record.image.height = record.plan.image.height;
        const double per_launch = make_cost_model(of_record).per_launch;
        return with_sum(stretched(costs_of_run(record, per_launch), probe.image.region),
                        make_cost_model(probe).render);
    } catch (const std::exception&) {  // not ours, or damaged: this run writes a new one
        return {};
    }
}

PartCosts costs_of_small_parts(const ProbeRequest& request, const ProbeResult& probe) {
    const ImageSize size = small_view(request.user_arguments).size;
    std::vector<Part> parts = parts_of(size);
    const std::filesystem::path folder = request.scratch / "parts";
    std::filesystem::create_directories(folder);
    double cpu_seconds = 0;
    for (std::size_t begin = 0; begin < parts.size(); begin += side_by_side) {
        const std::size_t end = std::min(parts.size(), begin + side_by_side);
        std::vector<ShortLaunch> launches;
        for (std::size_t i = begin; i < end; ++i)
            launches.push_back(
                launch(request, size, parts[i].rect, folder / fmt::format("part{}-", i)));
        wait_for_all(launches);
        for (std::size_t i = begin; i < end; ++i) {
            const ChildProcess& child = launches[i - begin].child;
            cpu_seconds += child.cpu_seconds();
            parts[i].cpu_seconds = std::max(least_cpu, parse_report(child.output()).trace_cpu);
            parts[i].failed = !launches[i - begin].succeeded();
        }
    }
    // One that took too long is dear, and of one that failed it is not known.
    const double dearest = std::max_element(parts.begin(), parts.end(), cheaper)->cpu_seconds;
    for (Part& part : parts)
        if (part.failed) part.cpu_seconds = dearest;
    const Rect& region = probe.image.region;
    const Rect small{0, 0, size.width, size.height};
    std::vector<CostPatch> patches;
    patches.reserve(parts.size());
    for (const Part& part : parts) patches.push_back({part.rect, part.cpu_seconds});
    const Rect image{0, 0, probe.image.width, probe.image.height};
    const CostMap of_image = stretched({small, std::move(patches)}, image);
    std::vector<CostPatch> in_region;
    for (const CostPatch& patch : of_image.patches()) {
        const Rect rect = intersect(patch.rect, region);
        if (!rect.empty()) in_region.push_back({rect, of_image.cpu_seconds(rect)});
    }
    return {with_sum(CostMap(region, std::move(in_region)), make_cost_model(probe).render),
            cpu_seconds, static_cast<int>(parts.size())};
}

}  // namespace mpipov
