// How a scene's text is given a camera that can be moved, without a change to the scene's own file:
// in a copy of the text every camera statement ends in
//
//     scale 1 + Mpipov_Camera_Move
//
// so that the camera's place comes to 1 + Mpipov_Camera_Move times as far from the origin, and
// nothing else of a perspective view changes: the lengths of direction, right and up do not matter
// as long as they grow together. (An orthographic view grows by as much.) The number is given on
// the command line (Declare=), of whose values POV-Ray keeps six digits: 1e-12 arrives, and
// 1.000000000001 would not. Pure: text in, text out.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mpipov {

// Declared in every render of ours; a scene may use the first one itself, and is then left alone.
// The second one is a shift in the scene's units, for cameras at the origin.
inline constexpr std::string_view camera_move_name = "Mpipov_Camera_Move";
inline constexpr std::string_view camera_shift_name = "Mpipov_Camera_Shift";
// What a camera that can be moved prints when the scene is parsed (#debug).
inline constexpr std::string_view camera_mark = "mpipov-moves-this-camera";

struct SceneText {
    std::vector<std::string> includes;  // the names behind #include, in order
    int cameras = 0;                    // statements; not declarations (#declare C = camera {...})
    bool moves_itself = false;          // it uses Mpipov_Camera_Move
};
SceneText read_scene_text(std::string_view text);

// The text with cameras that can be moved, and the files of `includes` by these other names.
std::string with_movable_camera(std::string_view text,
                                const std::map<std::string, std::string>& includes);

// A statement for a scene without any, whose camera is POV-Ray's own.
std::string movable_default_camera();

}  // namespace mpipov
