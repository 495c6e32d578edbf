#include "meet_ranks.h"

#include "event_loop.h"
#include "failure.h"
#include "interrupt.h"
#include "message_fields.h"
#include "scene_view.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

namespace mpipov {
namespace {

// How long ranks may take to come up after rank 0 did.
constexpr double hello_seconds = 60;
constexpr int most_cores = 1 << 16;

}  // namespace

MetRanks meet_ranks(const RankRecord& rank0, int pool0, Transport& transport,
                    const std::string& povray) {
    const auto size = static_cast<std::size_t>(transport.size());
    MetRanks met{std::vector<RankRecord>(size), std::vector<int>(size),
                 std::vector<std::string>(size)};
    met.ranks[0] = rank0;
    met.pools[0] = pool0;
    met.views[0] = point_of_view();
    std::vector<bool> known(size);
    known[0] = true;
    for (int missing = transport.size() - 1; missing > 0; --missing) {
        const auto message = wait_for_message(transport, hello_seconds);
        throw_if_interrupted();
        if (!message)
            throw Failure(Exit::interrupted, fmt::format("{} ranks did not come up within {:.0f} s",
                                                         missing, hello_seconds));
        const MessageFields fields(message->head);
        const std::string host = fields.text("host");
        if (message->kind == MessageKind::refused)
            throw Failure(fields.code("code"),
                          fmt::format("host {}: {}", host, fields.said("why")));
        const auto peer = static_cast<std::size_t>(message->peer);
        if (message->kind != MessageKind::hello || known.at(peer))
            throw std::runtime_error(
                fmt::format("host {} (rank {}) spoke before its turn", host, peer));
        known[peer] = true;
        if (const std::string theirs = fields.text("povray"); theirs != povray)
            throw Failure(Exit::scene,
                          fmt::format("host {} has POV-Ray {} and rank 0 has {}: their pixels "
                                      "could differ",
                                      host, theirs, povray));
        met.ranks[peer] = {message->peer, host, fields.number("slots", 0, most_cores), 0, 0};
        met.pools[peer] = fields.number("pool", 0, most_cores);
        met.views[peer] = fields.text("view");
    }
    return met;
}

}  // namespace mpipov
