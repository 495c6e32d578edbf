// The worker's part in bringing a scene to its host: says what it sees of it, and takes a copy.
#include "message_fields.h"
#include "scene_view.h"
#include "worker.h"

namespace mpipov {
namespace {

constexpr int coordinator = 0;

}  // namespace

void Worker::take_scene(const Message& message) {
    if (message.kind == MessageKind::look) {
        std::vector<std::filesystem::path> absolute;
        for (const std::string& name : MessageFields(message.head).texts("absolute"))
            absolute.emplace_back(name);
        const SceneView seen = view_scene(scene_request_from_json(message.head), absolute);
        transport_.send({MessageKind::seen, coordinator, to_json(seen), {}});
        return;
    }
    if (message.kind == MessageKind::pack)
        scene_.begin(scratch_ / "scene", pack_from_json(message.head));
    else
        scene_.take(message.body);
    if (scene_.complete())
        transport_.send({MessageKind::unpacked,
                         coordinator,
                         {{"folder", text_to_json(scene_.folder().string())}},
                         {}});
}

// A copy stays as it is for all jobs of a run: its text is looked through once.
void Worker::confine_launches(std::optional<SceneCopy> copy) {
    if (!copy)
        launch_confinement_ = confinement_;
    else if (copy_ != copy)
        launch_confinement_ = confinement_.in_copy(*copy);
    copy_ = std::move(copy);
}

}  // namespace mpipov
