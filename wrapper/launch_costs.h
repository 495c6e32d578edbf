// What a launch of POV-Ray costs, whatever the scene: measured, docs/architecture.md. One source
// for the planner, the coordinator and the simulator.
#pragma once

namespace mpipov {

constexpr double startup_wall_seconds = 0.7;      // idle: the core is free meanwhile
constexpr double bare_launch_cpu_seconds = 0.06;  // of an empty scene
// Of writing one pixel of the full frame around a section.
constexpr double frame_pixel_cpu_seconds = 70e-9;

}  // namespace mpipov
