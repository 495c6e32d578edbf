// The worker's part in bringing a scene to its host: says what it sees of it, and takes a copy.
#include "scene_view.h"
#include "worker.h"

namespace mpipov {
namespace {

constexpr int coordinator = 0;

}  // namespace

void Worker::take_scene(const Message& message) {
    if (message.kind == MessageKind::look) {
        std::vector<std::filesystem::path> absolute;
        for (const nlohmann::json& name : message.head.at("absolute"))
            absolute.emplace_back(name.get<std::string>());
        const SceneView seen = view_scene(scene_request_from_json(message.head), absolute);
        transport_.send({MessageKind::seen, coordinator, to_json(seen), {}});
        return;
    }
    if (message.kind == MessageKind::pack)
        scene_.begin(scratch_ / "scene", pack_from_json(message.head));
    else
        scene_.take(message.body);
    if (scene_.complete())
        transport_.send(
            {MessageKind::unpacked, coordinator, {{"folder", scene_.folder().string()}}, {}});
}

// A copy stays as it is for all jobs of a run: its text is looked through once.
void Worker::confine_launches(const nlohmann::json& head) {
    const std::filesystem::path copy = head.at("copy").get<std::string>();
    if (copy.empty()) {
        launch_confinement_ = confinement_;
        copy_.reset();
        return;
    }
    SceneCopy now{copy, copy / head.at("folder").get<std::string>(),
                  copy / head.at("ini").get<std::string>(), job_.user_arguments};
    if (copy_ == now) return;
    launch_confinement_ = confinement_.in_copy(now);
    copy_ = std::move(now);
}

}  // namespace mpipov
