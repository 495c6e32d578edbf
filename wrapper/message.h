// What ranks say to each other. One message is a kind, a small JSON head and raw bytes.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace mpipov {

enum class MessageKind : unsigned char {
    hello,      // worker: slots, host, POV-Ray's version
    job,        // coordinator: what is the same for every section
    assign,     // coordinator: render this section
    progress,   // worker: how far a section is
    band,       // worker: some rows of a section's pixels, in the body
    cache,      // coordinator: some bytes of a radiosity cache to be read, in the body
    samples,    // worker: some of those that a section has gathered, in the body
    done,       // worker: all bands of a section were sent; its times
    failed,     // worker: why a section did not work out
    cancel,     // coordinator: another rank was first with this section
    cancelled,  // worker: its launch is gone; what it spent
    stop,       // coordinator: no more work
    refused,    // worker: this rank cannot render at all, or no more
    alive,      // both: no more than that; when the sender will have spoken again
    look,       // coordinator: which of the scene's files do you see?
    seen,       // worker: these
    pack,       // coordinator: a list of files; their bytes follow
    piece,      // coordinator: some of those bytes, in the body
    unpacked,   // worker: where they are
    bye,        // worker: its last message
};

// Whether a rank's worker takes it: what only the coordinator says.
bool is_for_worker(MessageKind kind);

// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON only asserts
struct Message {
    MessageKind kind = MessageKind::stop;
    int peer = -1;  // to whom, or from whom
    nlohmann::json head;
    std::vector<std::byte> body;
};

// A band's pixels are at most this long, so that neither side holds much more than its own pixels.
constexpr std::size_t max_band_bytes = std::size_t{1} << 20;
// Nothing longer is accepted; a band, its head and some room.
constexpr std::size_t max_message_bytes = max_band_bytes + (std::size_t{8} << 20);

std::vector<std::byte> pack(const Message& message);
// Throws std::runtime_error where the bytes are no message of ours.
Message unpack(std::span<const std::byte> bytes, int from);

nlohmann::json rect_to_json(const struct Rect& rect);
// Throws std::runtime_error where it is anything else than four whole numbers from 0.
struct Rect rect_from_json(const nlohmann::json& json);

}  // namespace mpipov
