// What a probe found out about a scene.
#pragma once

#include "povray_text.h"
#include "run_record.h"

namespace mpipov {

// What the small probe renders said.
struct ProbeResult {
    ImageOptions image;            // of the whole render, as POV-Ray resolved it
    LaunchReport report;           // of the small render
    long long probe_pixels = 1;    // how many pixels the small render had
    bool order_dependent = false;  // the small render came out differently in another block order
    bool seen_whole = true;        // false: it showed the middle of the picture only
    bool own_cache = false;        // the user's settings name a radiosity cache to read or to write
    int user_block = 0;            // the user's own +BS, 0: POV-Ray's default
    ImageInfo stored;              // type, depth and channels of the file that POV-Ray wrote
};

}  // namespace mpipov
