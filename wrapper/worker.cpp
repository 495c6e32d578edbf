#include "worker.h"

#include "message_fields.h"
#include "povray_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace mpipov {
namespace {

constexpr int coordinator = 0;

}  // namespace

std::optional<std::filesystem::path> look_for_image(const std::filesystem::path& base) {
    const std::string name = base.filename();
    for (const auto& entry : std::filesystem::directory_iterator(base.parent_path())) {
        const std::string stem = entry.path().stem();
        // A frame of an animation has its number behind the name.
        if (stem.compare(0, name.size(), name) == 0 &&
            stem.find_first_not_of("0123456789", name.size()) == std::string::npos &&
            entry.path().extension() != ".pov-state")
            return entry.path();
    }
    return {};
}

std::filesystem::path find_image(const std::filesystem::path& base) {
    if (auto image = look_for_image(base)) return *std::move(image);
    throw std::runtime_error("POV-Ray wrote no image");
}

Worker::Worker(Transport& transport, std::filesystem::path scratch, Confinement confinement)
    : transport_(transport), scratch_(std::move(scratch)), confinement_(std::move(confinement)) {}

void Worker::handle(const Message& message) {
    switch (message.kind) {
        case MessageKind::job:
            take_job(message.head);
            break;
        case MessageKind::cache:
            cache_.take(message.body);
            break;
        case MessageKind::look:
        case MessageKind::pack:
        case MessageKind::piece:
            take_scene(message);
            break;
        case MessageKind::assign:
            start(message);
            break;
        case MessageKind::cancel:
            cancel(message);
            break;
        case MessageKind::stop:
            stop();
            break;
        default:
            throw std::runtime_error("a worker got a message that is not for workers");
    }
}

void Worker::start(const Message& message) {
    if (!cache_.complete())
        throw std::runtime_error("a section was assigned before its radiosity cache was sent");
    const MessageFields fields(message.head);
    const Section section{fields.section(), fields.rect("keep"), fields.rect("render")};
    const int attempt = fields.attempt();
    if (section.render.empty() || intersect(section.keep, section.render) != section.keep ||
        intersect(section.render, {0, 0, image_.width, image_.height}) != section.render)
        throw std::runtime_error("a section was assigned that does not lie in the image");
    try {
        PreparedLaunch prepared = launch(section, attempt);
        launches_.push_back(
            {section, attempt, std::move(prepared.folder), std::move(prepared.child)});
    } catch (const std::exception& error) {
        const bool disk = dynamic_cast<const std::filesystem::filesystem_error*>(&error) != nullptr;
        transport_.send({MessageKind::failed,
                         coordinator,
                         {{"section", section.id},
                          {"attempt", attempt},
                          {"why", error.what()},
                          {"code", static_cast<int>(disk ? Exit::file : Exit::scene)},
                          {"cpu_seconds", 0.0}},
                         {}});
    }
}

PreparedLaunch Worker::launch(const Section& section, int attempt) {
    if (adopted_ && adopted_for_ == section.id && attempt == 1 && !gathers_) {
        PreparedLaunch adopted = std::move(*adopted_);
        adopted_.reset();
        if (timeout_seconds_) adopted.child.set_timeout(*timeout_seconds_);
        return adopted;
    }
    // Launches of an earlier job may still be leaving.
    LaunchFolder folder(scratch_ / fmt::format("{}-{}-{}", jobs_, section.id, attempt));
    LaunchNeeds needs;
    needs.folder = folder.path();
    needs.timeout_seconds = timeout_seconds_;
    needs.threads = job_.threads;
    needs.pixels =
        static_cast<std::uint64_t>(image_.width) * static_cast<std::uint64_t>(image_.height);
    if (gathers_) {
        const std::filesystem::path cache = folder.path() / section_cache_name;
        const bool reads = !cache_.file().empty();
        // POV-Ray writes behind what it has read.
        if (reads) std::filesystem::copy_file(cache_.file(), cache);
        needs.argv = gather_command(job_, section.render, image_, cache, reads);
    } else {
        needs.argv =
            section_command(job_, section.render, image_, folder.path() / section_image_name);
    }
    if (!job_.radiosity_cache.empty()) needs.reads.push_back(job_.radiosity_cache);
    return {std::move(folder), ChildProcess::start(launch_confinement_.request(std::move(needs)))};
}

void Worker::adopt(int section, PreparedLaunch launch) {
    adopted_.emplace(std::move(launch));
    adopted_for_ = section;
}

nlohmann::json Worker::head_of(const Launch& launch) const {
    return {{"section", launch.section.id}, {"attempt", launch.attempt}};
}

bool Worker::step() {
    bool busy = false;
    for (auto it = launches_.begin(); it != launches_.end();) {
        const State state = step(*it);
        busy = busy || state != State::idle;
        if (state == State::over && !it->child.ended())
            leaving_.push_back({std::move(it->folder), std::move(it->child)});
        it = state == State::over ? launches_.erase(it) : std::next(it);
    }
    leaving_.remove_if([](PreparedLaunch& launch) { return launch.child.poll(); });
    return busy;
}

Worker::State Worker::step(Launch& launch) {
    try {
        if (launch.cancelled) return end_cancelled(launch);
        if (!launch.broken.empty()) return end_broken(launch);
        if (launch.sends()) return send_more(launch);
        if (launch.child.poll() ||
            launch.end.seen(launch.child, launch.folder.path() / section_image_name))
            return begin_reading(launch);
        send_progress(launch);
        return State::idle;
    } catch (const std::exception& error) {
        launch.broken = error.what();
        if (const auto* failure = dynamic_cast<const Failure*>(&error))
            launch.code = failure->code();
        launch.reader.reset();
        launch.samples.reset();
        return end_broken(launch);
    }
}

LaunchPlace Worker::place_of(const Launch& launch) const {
    return {launch.folder.path(), frame_bytes(image_.width, image_.height)};
}

// Where POV-Ray could not write its file it has not said so yet, and knows better why.
Worker::State Worker::end_broken(Launch& launch) {
    if (!launch.child.poll()) return State::idle;
    // POV-Ray may also end well though its file had no room.
    send_failure(launch, launch.child.result().exit_code == 0
                             ? blame_full_disk({launch.broken, launch.code}, place_of(launch))
                             : launch_failure(launch.child, launch_confinement_, place_of(launch)));
    return State::over;
}

// Nothing where it has ended meanwhile: the coordinator has heard of that.
void Worker::cancel(const Message& message) {
    const MessageFields fields(message.head);
    const int id = fields.section();
    const int attempt = fields.attempt();
    for (Launch& launch : launches_)
        if (launch.section.id == id && launch.attempt == attempt) {
            launch.cancelled = true;
            launch.child.kill_now();
        }
}

Worker::State Worker::end_cancelled(Launch& launch) {
    if (!launch.child.poll()) return State::idle;
    nlohmann::json head = head_of(launch);
    head["cpu_seconds"] = launch.child.result().cpu_seconds;
    transport_.send({MessageKind::cancelled, coordinator, std::move(head), {}});
    return State::over;
}

Worker::State Worker::begin_reading(Launch& launch) {
    if (launch.child.ended() && launch.child.result().exit_code != 0) {
        send_failure(launch, launch_failure(launch.child, launch_confinement_, place_of(launch)));
        return State::over;
    }
    if (gathers_)
        launch.samples = read_new_samples(launch.folder.path() / section_cache_name, cache_.bytes(),
                                          radiosity_samples(launch.child.output()));
    else
        launch.reader.emplace(find_image(launch.folder.path() / section_image_name), image_.width,
                              image_.height, launch.section.render, max_band_bytes);
    return State::busy;
}

// No more than two whole bands under way: the coordinator sets the pace.
Worker::State Worker::send_more(Launch& launch) {
    if (transport_.unsent_bytes() > max_band_bytes + max_band_bytes / 2) return State::idle;
    nlohmann::json head = head_of(launch);
    if (launch.samples) {
        auto piece = next_piece(*launch.samples, launch.samples_sent);
        if (!piece) return send_done(launch);
        transport_.send({MessageKind::samples, coordinator, std::move(head), *std::move(piece)});
        return State::busy;
    }
    std::optional<Band> band = launch.reader->next();
    if (!band) return send_done(launch);
    head["rect"] = rect_to_json(band->rect);
    transport_.send({MessageKind::band, coordinator, std::move(head), std::move(band->pixels)});
    return State::busy;
}

Worker::State Worker::send_done(const Launch& launch) {
    nlohmann::json head = head_of(launch);
    head["wall_seconds"] = launch.child.wall_seconds();
    head["cpu_seconds"] = launch.child.cpu_seconds();
    head["warnings"] = parse_warnings(launch.child.output());
    transport_.send({MessageKind::done, coordinator, std::move(head), {}});
    return State::over;
}

void Worker::send_progress(Launch& launch) {
    // Only in steps worth a message.
    const double fraction = std::min(parse_progress(launch.child.output()).value_or(0), 1.0);
    if (fraction < launch.last_fraction + 0.02) return;
    launch.last_fraction = fraction;
    nlohmann::json head = head_of(launch);
    head["fraction"] = fraction;
    transport_.send({MessageKind::progress, coordinator, std::move(head), {}});
}

void Worker::send_failure(const Launch& launch, const LaunchFailure& failure) {
    nlohmann::json head = head_of(launch);
    head["why"] = failure.why;
    head["code"] = static_cast<int>(failure.code);
    head["cpu_seconds"] = launch.child.ended() ? launch.child.result().cpu_seconds : 0.0;
    transport_.send({MessageKind::failed, coordinator, std::move(head), {}});
}

void Worker::add_poll_fds(std::vector<pollfd>& fds) const {
    for (const Launch& launch : launches_) {
        if (!launch.sends()) launch.child.add_poll_fds(fds);
    }
    for (const PreparedLaunch& launch : leaving_) launch.child.add_poll_fds(fds);
}

int Worker::wait_milliseconds(int at_most) const {
    int wait = at_most;
    for (const Launch& launch : launches_) {
        wait = std::min(wait, launch.sends() ? 1 : launch.child.wait_milliseconds());
        if (launch.end.near()) wait = std::min(wait, near_end_milliseconds);
    }
    return std::max(wait, 0);
}

void Worker::stop() {
    stopped_ = true;
    // First all of them, so that they end side by side; then ~ChildProcess waits for each.
    for (Launch& launch : launches_) launch.child.kill_now();
    for (PreparedLaunch& launch : leaving_) launch.child.kill_now();
    launches_.clear();
    leaving_.clear();
    adopted_.reset();
}

}  // namespace mpipov
