// The coordinator's part in radiosity caches: hands one out before the sections that read it, and
// takes in what sections gather.
#include "cache_stream.h"
#include "coordinator.h"

#include <fmt/format.h>

#include <stdexcept>

namespace mpipov {
namespace {

// What may wait for the network: not a copy of the cache for every rank at once.
constexpr std::size_t most_unsent_bytes = 8 * max_band_bytes;

}  // namespace

// As far as the network takes it; tick() goes on. A rank gets sections once it was fed.
void Coordinator::feed_caches() {
    for (std::size_t rank = 0; rank < fed_.size(); ++rank) {
        if (setup_.ranks[rank].slots == 0 || fed_[rank] == setup_.cache.size()) continue;
        while (transport_.unsent_bytes() < most_unsent_bytes) {
            auto piece = next_piece(setup_.cache, fed_[rank]);
            if (!piece) break;
            transport_.send({MessageKind::cache, static_cast<int>(rank), nlohmann::json::object(),
                             *std::move(piece)});
        }
        if (fed_[rank] < setup_.cache.size()) return;
        assign_to(static_cast<int>(rank));
    }
}

void Coordinator::take_samples(const Message& message) {
    const Source source = source_of(message);
    if (source.run == nullptr) return;
    if (!setup_.gathers)
        throw std::runtime_error(
            fmt::format("rank {} sent samples and was to render pixels", message.peer));
    keep_only(*source.progress, *source.run);
    if (message.body.size() > max_samples_bytes - source.progress->samples.size())
        throw std::runtime_error(
            fmt::format("rank {} sent more samples than a launch may gather", message.peer));
    source.progress->samples.append(reinterpret_cast<const char*>(message.body.data()),
                                    message.body.size());
}

std::vector<std::string> Coordinator::samples() const {
    std::vector<std::string> all;
    all.reserve(sections_.size());
    for (const Progress& progress : sections_) all.push_back(progress.samples);
    return all;
}

}  // namespace mpipov
