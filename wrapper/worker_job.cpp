// The worker's part in a job: takes what is the same for all of its sections.
#include "message_fields.h"
#include "worker.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

namespace mpipov {

void Worker::take_job(const nlohmann::json& head) {
    constexpr int most_pixels = 1 << 30, most_threads = 1 << 16;
    constexpr std::int64_t most_cache_bytes = std::int64_t{1} << 50;
    const MessageFields fields(head);
    const ImageSize image{fields.number("width", 1, most_pixels),
                          fields.number("height", 1, most_pixels)};
    JobCommand job{fields.text("povray"),
                   fields.texts("user_arguments"),
                   fields.texts("format_arguments"),
                   fields.number("threads", 1, most_threads),
                   fields.number("block", 0, most_pixels),
                   {}};
    const bool gathers = fields.flag("gathers");
    const std::uint64_t cache_bytes = fields.size("cache_bytes", most_cache_bytes);
    const std::string copy = fields.text("copy"), folder = fields.text("folder"),
                      ini = fields.text("ini");
    if (!copy.empty() && (!stays_inside(folder) || !stays_inside(ini)))
        throw std::runtime_error("a job is to run outside of its copy of the scene");
    timeout_seconds_ = fields.seconds_or_none("timeout_seconds");
    image_ = image;
    gathers_ = gathers;
    ++jobs_;
    cache_.begin(scratch_ / "radiosity.cache", cache_bytes);
    job.radiosity_cache = cache_.file();
    job_ = std::move(job);
    const std::filesystem::path root = copy;
    std::optional<SceneCopy> of_scene;
    if (!copy.empty()) of_scene = {root, root / folder, root / ini, job_.user_arguments};
    confine_launches(std::move(of_scene));
}

}  // namespace mpipov
