// When a launch of POV-Ray has done its work although it has not ended: POV-Ray 3.7 sleeps for 0.3
// seconds after it has closed its image (docs/povray.md).
#pragma once

#include "child_process.h"

#include <chrono>
#include <filesystem>
#include <optional>

namespace mpipov {

class EndOfWork {
  public:
    // Whether the statistics are printed, the image is there, and POV-Ray has had no file open for
    // a moment. All three: it may print before it has written the image, and the file that it keeps
    // a large image in is removed right after it was closed. `base`: as find_image().
    bool seen(const ChildProcess& child, const std::filesystem::path& base);

    // It will not be long: look again soon, because nothing will tell.
    bool near() const { return near_; }

  private:
    bool near_ = false;
    std::optional<std::chrono::steady_clock::time_point> since_;
};

// How long ::poll() may sleep where an end is near, milliseconds.
constexpr int near_end_milliseconds = 10;

}  // namespace mpipov
