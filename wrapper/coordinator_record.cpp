// What the coordinator writes down of a run, and takes from what an earlier one wrote.
#include "coordinator.h"

#include <algorithm>

namespace mpipov {

nlohmann::json about_section(const SectionRecord& record) {
    return {{"rank", record.rank},
            {"host", record.host},
            {"start", record.start},
            {"end", record.end},
            {"wall_seconds", record.wall_seconds},
            {"cpu_seconds", record.cpu_seconds},
            {"attempts", record.attempts}};
}

std::optional<std::uintmax_t> Coordinator::bytes_of(int section) const {
    if (section < 0 || section >= static_cast<int>(sections_.size())) return {};
    const Rect& render = sections_[static_cast<std::size_t>(section)].record.section.render;
    return static_cast<std::uintmax_t>(render.area()) * canvas_.layout().bytes_per_pixel();
}

void Coordinator::resume(int section, const nlohmann::json& what,
                         std::span<const std::byte> pixels) {
    Progress& progress = sections_.at(static_cast<std::size_t>(section));
    SectionRecord& record = progress.record;
    const Rect& render = record.section.render;
    canvas_.place(render, pixels, record.section.keep);
    overlap_.take(section, render, pixels);
    record.rank = what.at("rank");
    record.host = what.at("host");
    record.start = what.at("start");
    record.end = what.at("end");
    record.wall_seconds = what.at("wall_seconds");
    record.cpu_seconds = what.at("cpu_seconds");
    record.attempts = what.at("attempts");
    record.resumed = true;
    set_fraction(progress, 1);
    ++sections_done_;
    schedule_.finished(section);
    for (const int seam : overlap_.finish(section)) check_seam(seam);
}

void Coordinator::fill(RunRecord& record) const {
    record.sections.clear();
    record.repairs.clear();
    for (const Progress& progress : sections_)
        (progress.seam < 0 ? record.sections : record.repairs).push_back(progress.record);
    record.seams = seams_;
    record.ranks = setup_.ranks;
    record.totals.launches += totals_.launches;
    record.totals.retries += totals_.retries;
    record.totals.copies += totals_.copies;
    record.totals.cpu_seconds += totals_.cpu_seconds;
    for (const std::string& warning : warnings_)
        if (std::find(record.warnings.begin(), record.warnings.end(), warning) ==
            record.warnings.end())
            record.warnings.push_back(warning);
}

}  // namespace mpipov
