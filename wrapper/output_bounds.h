// Where a run may put its image, record and work folder. An INI file beside a scene is the scene's,
// and so are the links in its folder: neither must lead a run to write over other files.
#pragma once

#include "options.h"
#include "output_place.h"
#include "scene_folders.h"

namespace mpipov {

// The folder of the run, those of the files and of the output that the command line or the user's
// own povray.ini names, and --allow-write; links followed. Of a folder that
// is_for_more_than_a_scene() only what lies directly in it. Throws Failure(Exit::usage), with the
// way out. Nothing with --confine off.
void require_within_bounds(const OutputPlace& place, const Options& options,
                           const FolderRequest& user);

}  // namespace mpipov
