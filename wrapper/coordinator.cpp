#include "coordinator.h"

#include "failure.h"
#include "message_fields.h"
#include "never_back.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace mpipov {
namespace {

std::vector<int> ids_of(const Partition& partition) {
    std::vector<int> ids(partition.sections.size());
    std::iota(ids.begin(), ids.end(), 0);
    return ids;
}

std::vector<int> lanes_of(const std::vector<RankRecord>& ranks) {
    std::vector<int> lanes;
    lanes.reserve(ranks.size());
    for (const RankRecord& rank : ranks) lanes.push_back(rank.slots);
    return lanes;
}

}  // namespace

Coordinator::Coordinator(CoordinatorSetup setup, Transport& transport, Canvas& canvas,
                         Journal* journal, std::function<double()> clock)
    : setup_(std::move(setup)),
      transport_(transport),
      canvas_(canvas),
      journal_(journal),
      clock_(never_back(std::move(clock))),
      schedule_(setup_.policy, ids_of(setup_.partition), lanes_of(setup_.ranks), setup_.costs),
      overlap_(setup_.partition, canvas.layout()),
      seams_(overlap_.seams().size()),
      fed_(setup_.ranks.size(), 0),
      under_way_(setup_.ranks.size(), 0),
      busy_since_(setup_.ranks.size(), 0),
      pace_(setup_.ranks.size()) {
    for (const Section& section : setup_.partition.sections) {
        Progress progress;
        progress.record.section = section;
        pixels_ += static_cast<double>(section.keep.area());
        sections_.push_back(std::move(progress));
    }
    if (setup_.policy == Policy::cost && !setup_.costs.empty()) {
        neighbours_.resize(sections_.size());
        for (const Seam& seam : overlap_.seams()) {
            neighbours_[static_cast<std::size_t>(seam.a)].push_back(seam.b);
            neighbours_[static_cast<std::size_t>(seam.b)].push_back(seam.a);
        }
    }
    for (std::size_t i = 0; i < seams_.size(); ++i) seams_[i].seam = overlap_.seams()[i];
}

void Coordinator::start() {
    const nlohmann::json common{
        {"povray", text_to_json(setup_.job.povray)},
        {"user_arguments", texts_to_json(setup_.job.user_arguments)},
        {"format_arguments", texts_to_json(setup_.job.format_arguments)},
        {"threads", setup_.job.threads},
        {"block", setup_.job.block},
        {"width", setup_.image.width},
        {"height", setup_.image.height},
        {"gathers", setup_.gathers},
        {"cache_bytes", setup_.cache.size()},
        {"copy", ""},
        {"folder", ""},
        {"ini", ""},
        {"timeout_seconds",
         setup_.timeout_seconds ? nlohmann::json(*setup_.timeout_seconds) : nlohmann::json()}};
    for (std::size_t rank = 0; rank < setup_.ranks.size(); ++rank) {
        nlohmann::json head = common;
        if (const auto copy = setup_.shipped.copy_for(rank); !copy.empty()) {
            head["user_arguments"] = texts_to_json(setup_.shipped.arguments);
            head["copy"] = text_to_json(copy.string());
            head["folder"] = text_to_json(setup_.shipped.folder);
            head["ini"] = text_to_json(setup_.shipped.ini);
        }
        transport_.send({MessageKind::job, static_cast<int>(rank), std::move(head), {}});
    }
    feed_caches();
    assign_to_all();
}

void Coordinator::assign_to_all() {
    // One each in turn, so that a first rank does not take what would fill the others' cores.
    for (bool given = true; given;) {
        given = false;
        for (int rank = 0; rank < static_cast<int>(setup_.ranks.size()); ++rank) {
            const int before = under_way_[static_cast<std::size_t>(rank)];
            assign_to(rank);
            given = given || under_way_[static_cast<std::size_t>(rank)] != before;
        }
    }
}

void Coordinator::assign_to(int worker) {
    const auto rank = static_cast<std::size_t>(worker);
    if (fed_[rank] < setup_.cache.size() || under_way_[rank] >= setup_.in_flight.at(rank)) return;
    if (const std::optional<int> next = schedule_.next(worker)) begin(*next, worker);
}

void Coordinator::begin(int id, int worker) {
    Progress& progress = sections_[static_cast<std::size_t>(id)];
    const Section& section = progress.record.section;
    const Run run{worker, schedule_.attempts(id), clock_(), 0};
    if (progress.runs.empty()) {
        set_fraction(progress, 0);
        // Whatever came of an earlier attempt does not count.
        progress.next_row = section.render.y0;
        progress.disagreement.differing = 0;
        progress.disagreement.max_difference = 0;
        progress.samples.clear();
        if (run.attempt > 1) ++totals_.retries;
    } else {
        ++totals_.copies;
    }
    progress.runs.push_back(run);
    const auto rank = static_cast<std::size_t>(worker);
    if (under_way_[rank]++ == 0) busy_since_[rank] = run.start;
    ++totals_.launches;
    transport_.send({MessageKind::assign,
                     worker,
                     {{"section", id},
                      {"attempt", run.attempt},
                      {"keep", rect_to_json(section.keep)},
                      {"render", rect_to_json(section.render)}},
                     {}});
}

void Coordinator::end_launch(int worker, double cpu_seconds) {
    const auto rank = static_cast<std::size_t>(worker);
    totals_.cpu_seconds += cpu_seconds;
    if (--under_way_[rank] == 0) setup_.ranks[rank].busy_seconds += clock_() - busy_since_[rank];
}

void Coordinator::handle(const Message& message) {
    switch (message.kind) {
        case MessageKind::progress:
            take_progress(message);
            break;
        case MessageKind::band:
            take_band(message);
            break;
        case MessageKind::samples:
            take_samples(message);
            break;
        case MessageKind::done:
            take_done(message);
            break;
        case MessageKind::failed:
            take_failed(message);
            break;
        case MessageKind::cancelled:
            take_end_of_loser(message);
            break;
        default:
            throw std::runtime_error("the coordinator got a message that is not for it");
    }
    furthest_ = fraction();
}

Coordinator::Source Coordinator::source_of(const Message& message) {
    const MessageFields fields(message.head);
    const int id = fields.section();
    const int attempt = fields.attempt();
    if (id >= static_cast<int>(sections_.size()))
        throw std::runtime_error(fmt::format("rank {} sent an unknown section", message.peer));
    Progress& progress = sections_[static_cast<std::size_t>(id)];
    for (Run& run : progress.runs)
        if (run.rank == message.peer && run.attempt == attempt) return {&progress, &run};
    if (losers_.count({id, attempt, message.peer}) > 0) return {&progress, nullptr};
    throw std::runtime_error(
        fmt::format("rank {} sent section {} that it was not given", message.peer, id));
}

void Coordinator::set_fraction(Progress& progress, double fraction) {
    const double now = std::clamp(fraction, 0.0, 1.0);
    pixels_done_ +=
        static_cast<double>(progress.record.section.keep.area()) * (now - progress.fraction);
    progress.fraction = now;
}

void Coordinator::take_progress(const Message& message) {
    const Source source = source_of(message);
    if (source.run == nullptr) return;
    source.run->fraction = MessageFields(message.head).part("fraction");
    set_fraction(*source.progress, std::max(source.progress->fraction, source.run->fraction));
}

void Coordinator::take_band(const Message& message) {
    const Source source = source_of(message);
    if (source.run == nullptr) return;
    if (setup_.gathers)
        throw std::runtime_error(
            fmt::format("rank {} sent pixels and was to gather samples", message.peer));
    Progress& progress = *source.progress;
    keep_only(progress, *source.run);
    const Section& section = progress.record.section;
    const Rect rect = MessageFields(message.head).rect("rect");
    if (rect.empty() || intersect(rect, section.render) != rect)
        throw std::runtime_error(
            fmt::format("rank {} sent pixels outside of section {}", message.peer, section.id));
    if (rect.x0 != section.render.x0 || rect.x1 != section.render.x1 ||
        rect.y0 != progress.next_row)
        throw std::runtime_error(fmt::format("rank {} sent other rows of section {} than its next",
                                             message.peer, section.id));
    const std::size_t bytes =
        static_cast<std::size_t>(rect.area()) * canvas_.layout().bytes_per_pixel();
    if (message.body.size() != bytes)
        throw std::runtime_error(fmt::format(
            "rank {} sent {} bytes of section {} for {}x{} pixels "
            "that take {}",
            message.peer, message.body.size(), section.id, rect.width(), rect.height(), bytes));
    progress.next_row = rect.y1;
    if (progress.seam >= 0) {
        take_repair_band(progress, rect, message.body);
        return;
    }
    canvas_.place(rect, message.body, section.keep);
    overlap_.take(section.id, rect, message.body);
    if (journal_ != nullptr) journal_->take(section.id, section.render, rect, message.body);
}

void Coordinator::take_done(const Message& message) {
    const Source source = source_of(message);
    if (source.run == nullptr) return take_end_of_loser(message);
    const MessageFields fields(message.head);
    const double wall_seconds = fields.seconds("wall_seconds");
    const double cpu_seconds = fields.seconds("cpu_seconds");
    const std::vector<std::string> warnings = fields.all_said("warnings");
    Progress& progress = *source.progress;
    SectionRecord& record = progress.record;
    if (!setup_.gathers && progress.next_row != record.section.render.y1)
        throw std::runtime_error(fmt::format("rank {} ended section {} without all of its rows",
                                             message.peer, record.section.id));
    record.rank = message.peer;
    record.host = setup_.ranks[static_cast<std::size_t>(message.peer)].host;
    record.attempts = source.run->attempt;
    record.start = source.run->start;
    record.end = clock_();
    record.wall_seconds = wall_seconds;
    record.cpu_seconds = cpu_seconds;
    for (const std::string& warning : warnings)
        if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
            warnings_.push_back(warning);
    progress.runs.clear();
    set_fraction(progress, 1);
    ++sections_done_;
    ++setup_.ranks[static_cast<std::size_t>(message.peer)].sections;
    end_launch(message.peer, record.cpu_seconds);
    learn(record);
    correct_neighbours(record.section.id);
    if (progress.seam >= 0) {
        schedule_.finished(record.section.id);
        check_repair(progress);
    } else {
        if (journal_ != nullptr) journal_->finish(record.section.id, about_section(record));
        schedule_.finished(record.section.id);
        // `progress` dangles as soon as repair() adds a section.
        for (const int seam : overlap_.finish(record.section.id)) check_seam(seam);
    }
    assign_to_all();
}

void Coordinator::take_failed(const Message& message) {
    const Source source = source_of(message);
    if (source.run == nullptr) return take_end_of_loser(message);
    const MessageFields fields(message.head);
    const double cpu_seconds = fields.seconds("cpu_seconds");
    const Exit code = fields.code("code");
    const std::string why = fields.said("why");
    Progress& progress = *source.progress;
    const int id = progress.record.section.id;
    std::erase_if(progress.runs, [&](const Run& run) { return &run == source.run; });
    end_launch(message.peer, cpu_seconds);
    schedule_.failed(id, message.peer);
    // Where another rank has it under way too, that may still come out well.
    if (progress.runs.empty() && schedule_.failures(id) > setup_.retries)
        throw Failure(
            code,
            fmt::format("section {} failed {} times, last on {}: {}", id, schedule_.failures(id),
                        setup_.ranks[static_cast<std::size_t>(message.peer)].host, why));
    assign_to_all();
}

double Coordinator::fraction() const {
    if (finished()) return 1;
    return std::clamp(pixels_done_ / pixels_, furthest_, 1.0);
}

}  // namespace mpipov
