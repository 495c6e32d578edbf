#include "stability_measure.h"

#include "camera_move.h"
#include "failure.h"
#include "movable_scene.h"
#include "scratch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

constexpr std::array moves{1e-12, 1e-9, 1e-6};
constexpr double control_move = 1e-3;
constexpr const char* copies = "scene";  // of the scene's files, with a camera that moves
constexpr std::array moves_for_map{-1e-12, 3e-12, -1e-11, 3e-11, -1e-10};

class Measure {
  public:
    Measure(const StabilityRequest& request, const SceneAsked& scene, Stability& found)
        : request_(request),
          scene_(scene),
          found_(found),
          renderer_(request.povray, request.arguments, scratch_.path(), request.rules,
                    {scratch_.path() / copies}) {}

    AnswerMap run() {
        found_.reference = request_.reference ? *request_.reference : render("as-it-is", {});
        movable_ = make_movable(
            scene_.file, scene_.library_paths, scratch_.path() / copies,
            [&](const fs::path& file) { return renderer_.confinement().may_read(file); });
        found_.cameras = movable_.cameras;
        found_.way = movable_.moves_itself ? CameraWay::declared : CameraWay::scale;
        require_movable();
        move_all();
        if (found_.moves.back().comparison.identical()) find_another_way();
        AnswerMap map(found_.reference.image);
        for (CameraMove& one : found_.moves) one.answering = map.add(one.render.image, one.move);
        if (found_.control)  // too large a move for the map
            found_.control->answering =
                AnswerMap(found_.reference.image).add(found_.control->render.image, control_move);
        judge();
        if (request_.full_map && found_.verdict->kind == Conditioning::ill) fill(map);
        return map;
    }

  private:
    SerialRender render(const std::string& name, const std::vector<std::string>& more) const {
        SerialRender made = renderer_.render(name, more, request_.folder);
        fmt::print(stderr, "rendered {}\n", name);
        request_.told();
        return made;
    }

    CameraMove moved(double move, const std::string& name) const {
        std::vector<std::string> arguments = movable_.arguments;
        const bool shift = found_.way == CameraWay::shift;
        arguments.push_back(fmt::format("Declare={}={}", camera_move_name, shift ? 0 : move));
        arguments.push_back(fmt::format("Declare={}={}", camera_shift_name, shift ? move : 0));
        CameraMove one;
        one.move = move;
        one.render = render(name, arguments);
        one.comparison = compare_images({found_.reference.image, one.render.image, {}});
        return one;
    }

    [[noreturn]] void cannot_be_moved(const std::string& why) const {
        throw Failure(
            Exit::scene,
            fmt::format("cannot move the camera of '{}': {}; the scene can offer to move it: "
                        "#ifndef ({}) #declare {} = 0; #end, and in its camera, behind the rest, "
                        "scale 1 + {}",
                        scene_.file, why, camera_move_name, camera_move_name, camera_move_name));
    }

    // That the copy is the scene, and that its cameras are those that POV-Ray sees.
    void require_movable() const {
        const CameraMove rest = moved(0, "not-moved");
        if (!movable_.moves_itself && rest.render.text.find(camera_mark) == std::string::npos)
            cannot_be_moved(
                "POV-Ray does not come to the camera that stands in its text or in "
                "what it includes");
        if (!rest.comparison.identical())
            cannot_be_moved(fmt::format(
                "{} pixels of a copy whose camera has not moved differ from the scene itself{}",
                rest.comparison.metrics.counts.differing,
                movable_.cameras == 0 ? " (no camera statement was found)" : ""));
        std::error_code ignored;
        fs::remove(rest.render.image, ignored);
    }

    void move_all() {
        found_.moves.clear();
        for (const double move : moves)
            found_.moves.push_back(moved(move, "moved-" + move_text(move)));
    }

    // Where the largest move changes nothing: is the camera at the origin?
    void find_another_way() {
        found_.control = moved(control_move, "control");
        if (!found_.control->comparison.identical() || found_.way == CameraWay::declared) return;
        found_.way = CameraWay::shift;
        found_.control = moved(control_move, "control");
        move_all();
        if (!found_.moves.back().comparison.identical()) found_.control.reset();
    }

    void fill(AnswerMap& map) const {
        for (std::size_t i = 0; i < moves_for_map.size(); ++i) {
            const double move = moves_for_map[i];
            const CameraMove one = moved(move, fmt::format("for-map-{}", i + 1));
            map.add(one.render.image, std::abs(move));
            std::error_code ignored;
            fs::remove(one.render.image, ignored);
        }
    }

    void judge() {
        ConditioningFacts facts;
        facts.pixels = scene_.pixels;
        facts.order_dependent = scene_.order_dependent;
        for (const CameraMove& one : found_.moves)
            facts.answers.push_back(
                {one.move, one.answering, one.comparison.metrics.all.mean_abs().value_or(0)});
        found_.noise = request_.noise;
        if (facts.order_dependent && answers_nothing(facts) && !found_.noise)
            found_.noise = noise_of_other_orders();
        facts.noise = found_.noise;
        found_.verdict = judge_conditioning(facts);
    }

    std::optional<double> noise_of_other_orders() const {
        NoiseRequest wanted;
        wanted.wanted = fewest_noise_renders;
        wanted.order_dependent = true;
        wanted.keep_blocks = sees_blocks(found_.reference.report);
        wanted.folder = request_.folder / "noise";
        wanted.told = [&](const std::string& name) {
            fmt::print(stderr, "rendered {}\n", name);
            request_.told();
        };
        const NoiseRenders noise = render_noise(renderer_, found_.reference, wanted);
        std::optional<double> largest;
        for (const SerialRender& one : noise.renders) {
            const Comparison comparison = compare_images({found_.reference.image, one.image, {}});
            largest = std::max(largest.value_or(0), comparison.metrics.all.mean_abs().value_or(0));
        }
        return largest;
    }

    const StabilityRequest& request_;
    const SceneAsked& scene_;
    Stability& found_;
    const ScratchFolder scratch_{"stability"};
    const SerialRenderer renderer_;
    MovableScene movable_;
};

}  // namespace

AnswerMap measure_stability(const StabilityRequest& request, const SceneAsked& scene,
                            Stability& found) {
    return Measure(request, scene, found).run();
}

}  // namespace mpipov
