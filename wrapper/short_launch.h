// A launch of POV-Ray that is waited for side by side with others: of a probe, of a small part.
#pragma once

#include "child_process.h"
#include "end_of_work.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mpipov {

struct ShortLaunch {
    std::filesystem::path base;  // of its image, as find_image(); in the launch's folder
    ChildProcess child;
    EndOfWork end = {};
    bool enough = false;  // has done its work or was stopped by us; it may not have ended

    static ShortLaunch start(const ChildRequest& request, std::filesystem::path base);

    // Looks after it; whether it is over.
    bool poll();
    bool over() const { return enough || child.ended(); }
    bool succeeded() const { return enough || (child.ended() && child.result().exit_code == 0); }
    bool timed_out() const { return child.ended() && child.result().timed_out; }
};

// Until all are over. Throws Failure(Exit::interrupted).
void wait_for_all(std::span<ShortLaunch> launches);

// Sleeps until one that is not over may need looking after.
void sleep_on(std::span<const ShortLaunch> launches);

}  // namespace mpipov
