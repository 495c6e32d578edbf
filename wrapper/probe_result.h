// What a probe found out about a scene.
#pragma once

#include "povray_text.h"
#include "run_record.h"

#include <map>
#include <optional>

namespace mpipov {

// One picture at POV-Ray's quality levels (+Qn), each of which adds to the one before: 4 shadows,
// 5 area lights, 6 refraction and transparency, 8 reflection and normals, 9 media, radiosity,
// photons and subsurface scattering (docs/povray.md). What is missing between two is the same.
struct QualityLook {
    long long pixels = 1;                // how many the picture has
    std::optional<LaunchReport> report;  // as the user has it, where it is larger than the probe's
    std::map<int, LaunchReport> plain;   // by level, without antialiasing; the last is the user's
};

// What the small probe renders said.
struct ProbeResult {
    ImageOptions image;            // of the whole render, as POV-Ray resolved it
    LaunchReport report;           // of the small render
    LaunchReport plain;            // of the same without antialiasing
    long long probe_pixels = 1;    // how many pixels the small render had
    bool order_dependent = false;  // the small render came out differently in another block order
    bool seen_whole = true;        // false: it showed the middle of the picture only
    int quality = 9;               // the user's own +Q, at most 9
    bool own_cache = false;        // the user's settings name a radiosity cache to read
    bool writes_cache = false;     // and one to write
    int user_block = 0;            // the user's own +BS, 0: POV-Ray's default
    ImageInfo stored;              // type, depth and channels of the file that POV-Ray wrote
    std::optional<QualityLook> look;  // empty: the levels were not asked for
};

}  // namespace mpipov
