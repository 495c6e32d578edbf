// What a launch of POV-Ray costs, whatever the scene: measured, docs/povray.md and architecture.md.
// One source for the planner, the coordinator and the simulator.
#pragma once

namespace mpipov {

// Idle, before it traces: the core is free meanwhile. What it sleeps after its work is not waited
// for (end_of_work.h).
constexpr double startup_wall_seconds = 0.32;
constexpr double bare_launch_cpu_seconds = 0.06;  // of an empty scene
// Of writing one pixel of the full frame around a section.
constexpr double frame_pixel_cpu_seconds = 70e-9;

}  // namespace mpipov
