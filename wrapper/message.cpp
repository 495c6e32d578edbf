#include "message.h"

#include "json_input.h"
#include "section.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace mpipov {
namespace {

// Wire form: kind (1 byte), length of the head (4 bytes, little-endian), head, body.
constexpr std::size_t prefix_bytes = 5;

}  // namespace

bool is_for_worker(MessageKind kind) {
    return kind == MessageKind::job || kind == MessageKind::assign || kind == MessageKind::cancel ||
           kind == MessageKind::stop || kind == MessageKind::look || kind == MessageKind::pack ||
           kind == MessageKind::piece || kind == MessageKind::cache;
}

std::vector<std::byte> pack(const Message& message) {
    const std::string head =
        message.head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::vector<std::byte> bytes(prefix_bytes + head.size() + message.body.size());
    bytes[0] = static_cast<std::byte>(message.kind);
    for (std::size_t i = 0; i < 4; ++i)
        bytes[1 + i] = static_cast<std::byte>((head.size() >> (8 * i)) & 0xffU);
    std::memcpy(bytes.data() + prefix_bytes, head.data(), head.size());
    if (!message.body.empty())
        std::memcpy(bytes.data() + prefix_bytes + head.size(), message.body.data(),
                    message.body.size());
    return bytes;
}

Message unpack(std::span<const std::byte> bytes, int from) {
    if (bytes.size() < prefix_bytes || bytes.size() > max_message_bytes)
        throw std::runtime_error("a message between ranks has an impossible size");
    if (static_cast<MessageKind>(bytes[0]) > MessageKind::bye)
        throw std::runtime_error("a message between ranks is of an unknown kind");
    std::size_t head_size = 0;
    for (std::size_t i = 0; i < 4; ++i)
        head_size |= std::to_integer<std::size_t>(bytes[1 + i]) << (8 * i);
    if (head_size > bytes.size() - prefix_bytes)
        throw std::runtime_error("a message between ranks is cut short");
    Message message;
    message.kind = static_cast<MessageKind>(bytes[0]);
    message.peer = from;
    const auto head = bytes.subspan(prefix_bytes, head_size);
    try {
        message.head = parse_json({reinterpret_cast<const char*>(head.data()), head.size()});
    } catch (const std::runtime_error&) {
        throw std::runtime_error("a message between ranks has an unreadable head");
    }
    const auto body = bytes.subspan(prefix_bytes + head_size);
    message.body.assign(body.begin(), body.end());
    return message;
}

nlohmann::json rect_to_json(const Rect& r) {
    return nlohmann::json::array({r.x0, r.y0, r.x1, r.y1});
}

Rect rect_from_json(const nlohmann::json& j) {
    // Copies only what is there: get<std::array>() takes the first four of more.
    if (!j.is_array() || j.size() != 4)
        throw std::runtime_error("a rectangle is not four whole numbers");
    const Rect rect{whole_number<int>(j[0]), whole_number<int>(j[1]), whole_number<int>(j[2]),
                    whole_number<int>(j[3])};
    // So that no width or height overflows.
    if (std::min({rect.x0, rect.y0, rect.x1, rect.y1}) < 0)
        throw std::runtime_error("a rectangle has a negative edge");
    return rect;
}

}  // namespace mpipov
