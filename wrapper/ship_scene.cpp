#include "ship_scene.h"

#include "event_loop.h"
#include "failure.h"
#include "fingerprint.h"
#include "interrupt.h"
#include "journal.h"
#include "message_fields.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <utility>

namespace mpipov {
namespace {

constexpr std::size_t most_unsent_bytes = 8 * max_band_bytes;

// Ranks that see the same files; the first of them answers for all.
struct Place {
    std::string host, key;
    std::vector<int> ranks;
    SceneView view;
};

std::vector<Place> other_places(const std::vector<ShipRequest::Rank>& ranks) {
    std::vector<Place> places;
    for (std::size_t rank = 1; rank < ranks.size(); ++rank) {
        const auto& [host, key] = ranks[rank];
        const auto is_here = [&key = key](const std::string& other) {
            return !key.empty() && key == other;
        };
        if (is_here(ranks[0].view)) continue;
        auto place =
            std::ranges::find_if(places, [&](const Place& known) { return is_here(known.key); });
        if (place == places.end()) place = places.insert(place, {host, key, {}, {}});
        place->ranks.push_back(static_cast<int>(rank));
    }
    return places;
}

class Talk {
  public:
    Talk(Transport& transport, std::vector<Place>& places, double patience_seconds)
        : transport_(transport), places_(places), patience_(patience_seconds) {}

    void send_to_all(MessageKind kind, const nlohmann::json& head,
                     const std::vector<std::byte>& body = {}) {
        for (const Place& place : places_) transport_.send({kind, place.ranks.front(), head, body});
    }

    // One answer of each.
    void hear_all(MessageKind kind, const std::function<void(Place&, const nlohmann::json&)>& use) {
        std::vector<const Place*> heard;
        while (heard.size() < places_.size()) {
            const auto message = wait_for_message(transport_, patience_);
            throw_if_interrupted();
            if (!message) throw Failure(Exit::interrupted, silence(heard));
            Place& place = place_of(*message);
            if (message->kind != kind || std::ranges::find(heard, &place) != heard.end())
                throw std::runtime_error("a rank spoke out of turn of the scene's files");
            use(place, message->head);
            heard.push_back(&place);
        }
    }

    // Not more than the network takes. Meanwhile nobody has anything to say but why not.
    void wait_until_sent() {
        using Seconds = std::chrono::duration<double>;
        const auto begin = std::chrono::steady_clock::now();
        while (transport_.unsent_bytes() > most_unsent_bytes) {
            throw_if_interrupted();
            if (const auto message = transport_.try_receive()) {
                place_of(*message);
                throw std::runtime_error("a rank spoke while it was sent the scene");
            }
            if (Seconds(std::chrono::steady_clock::now() - begin).count() > patience_)
                throw Failure(Exit::interrupted, silence({}));
            ::poll(nullptr, 0, 1);
        }
    }

  private:
    Place& place_of(const Message& message) {
        for (Place& place : places_) {
            if (place.ranks.front() != message.peer) continue;
            const MessageFields fields(message.head);
            if (message.kind == MessageKind::refused)
                throw Failure(fields.code("code"),
                              fmt::format("host {}: {}", place.host, fields.said("why")));
            return place;
        }
        throw std::runtime_error("a rank spoke of the scene's files that was not asked");
    }

    std::string silence(const std::vector<const Place*>& heard) const {
        for (const Place& place : places_)
            if (std::ranges::find(heard, &place) == heard.end())
                return fmt::format("host {} did not take up the scene within {:.0f} s", place.host,
                                   patience_);
        return "a host did not take up the scene";
    }

    Transport& transport_;
    std::vector<Place>& places_;
    double patience_;
};

void send_file(Talk& talk, const Packing::Source& source, const PackedFile& file) {
    const auto changed = [&] {
        return Failure(Exit::file,
                       fmt::format("'{}' changed while it was sent to other hosts: start again",
                                   source.file.string()));
    };
    std::ifstream in;
    if (!source.text) in.open(source.file, std::ios::binary);
    for (std::uint64_t at = 0; at < file.bytes;) {
        std::vector<std::byte> piece(std::min<std::uint64_t>(max_band_bytes, file.bytes - at));
        if (source.text)
            std::copy_n(reinterpret_cast<const std::byte*>(source.text->data()) + at, piece.size(),
                        piece.begin());
        else if (!in.read(reinterpret_cast<char*>(piece.data()),
                          static_cast<std::streamsize>(piece.size())))
            throw changed();
        at += piece.size();
        talk.send_to_all(MessageKind::piece, nlohmann::json::object(), piece);
        talk.wait_until_sent();
    }
}

// What is not sent must be there.
void require_absolute(const Packing& packing, const SceneView& ours, const Place& place) {
    for (const std::filesystem::path& file : packing.absolute) {
        const std::string name = file.string();
        const auto there = place.view.files.find(name);
        if (there != place.view.files.end() && there->second == ours.files.at(name)) continue;
        throw Failure(
            Exit::file,
            fmt::format("host {} {} '{}', and the scene names it by its absolute name, which "
                        "leads to no copy: name it relative to the scene, or put it there",
                        place.host, there == place.view.files.end() ? "lacks" : "has another",
                        name));
    }
}

// What is sent is compared byte by byte when it has arrived.
SceneView read_as_a_whole(SceneView view) {
    for (auto& [file, seen] : view.files)
        if (!seen.empty() && !is_of_whole_file(seen)) seen = sha1_of_file(file);
    return view;
}

}  // namespace

Shipping ship_scene(const ShipRequest& request, Transport& transport) {
    std::vector<Place> places = other_places(request.ranks);
    if (places.empty()) return {};
    const SceneView ours = view_scene(request.scene);
    nlohmann::json look = to_json(request.scene);
    look["absolute"] = nlohmann::json::array();
    for (const std::filesystem::path& file : scene_names(request.scene).absolute_in_text)
        look["absolute"].push_back(text_to_json(file.string()));
    Talk(transport, places, request.patience_seconds).send_to_all(MessageKind::look, look);
    Talk(transport, places, request.patience_seconds)
        .hear_all(MessageKind::seen, [](Place& place, const nlohmann::json& head) {
            place.view = scene_view_from_json(head);
        });
    if (request.ship != Ship::on)
        std::erase_if(places,
                      [&](const Place& place) { return difference(ours, place.view).empty(); });
    if (places.empty()) return {};
    if (request.ship == Ship::off)
        throw Failure(Exit::file,
                      fmt::format("host {} {}: leave --ship off away, and it is sent",
                                  places.front().host, difference(ours, places.front().view)));
    const Packing packing =
        pack_scene(request.scene, request.arguments, read_as_a_whole(ours), request.may_go);
    for (const Place& place : places) require_absolute(packing, ours, place);

    Talk talk(transport, places, request.patience_seconds);
    talk.send_to_all(MessageKind::pack, to_json(packing.pack));
    for (std::size_t i = 0; i < packing.pack.files.size(); ++i)
        send_file(talk, packing.sources[i], packing.pack.files[i]);
    Shipping shipping;
    shipping.scene = {{}, packing.arguments, packing.pack.folder, packing.pack.ini};
    shipping.scene.copies.resize(request.ranks.size());
    talk.hear_all(MessageKind::unpacked, [&](Place& place, const nlohmann::json& head) {
        const std::string folder = MessageFields(head).text("folder");
        for (const int rank : place.ranks)
            shipping.scene.copies[static_cast<std::size_t>(rank)] = folder;
        shipping.hosts.push_back(place.host);
    });
    shipping.files = packing.pack.files.size();
    shipping.bytes = bytes_of(packing.pack);
    std::ranges::sort(shipping.hosts);
    return shipping;
}

}  // namespace mpipov
