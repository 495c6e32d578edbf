// What comes from other ranks: messages, rectangles in them, radiosity caches.
#include "entry.h"
#include "message.h"
#include "section.h"

#include <algorithm>

namespace {

using namespace mpipov;
using fuzz::require;

void use_rectangle(const nlohmann::json& head) {
    if (!head.is_object() || !head.contains("rect")) return;
    const Rect rect = rect_from_json(head.at("rect"));
    require(rect.area() >= 0, "an area is not negative");
    require(rect_from_json(rect_to_json(rect)) == rect, "a rectangle comes back as it was");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    try {
        const Message message = unpack(bytes, 3);
        require(message.peer == 3 && message.body.size() < size, "a message is what was sent");
        const std::vector<std::byte> packed = pack(message);
        const Message again = unpack(packed, 3);
        require(
            again.kind == message.kind && again.head == message.head && again.body == message.body,
            "a message comes back as it was");
        use_rectangle(message.head);
    } catch (const std::runtime_error& error) {
        require(error.what()[0] != '\0', "an error says something");
    }
    return 0;
}
