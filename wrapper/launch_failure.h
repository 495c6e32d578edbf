// Why a launch of POV-Ray that has ended did not work out, for the user: its time was up, a limit,
// a signal, or else POV-Ray's own words, with what can be done about it where a limit of ours was
// the cause; and whether it may have been the disk.
#pragma once

#include "child_process.h"
#include "confinement.h"
#include "failure.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace mpipov {

struct LaunchFailure {
    std::string why;
    Exit code = Exit::scene;  // Exit::file: the disk
};

// Where a launch writes its files, which must still be there, and what those may take.
struct LaunchPlace {
    std::filesystem::path folder;
    std::uintmax_t frame_bytes = 0;
};

LaunchFailure launch_failure(const ChildProcess& child, const Confinement& confinement,
                             const LaunchPlace& place);

// The same but for the disk, of one that ended so and said this.
std::string describe_failure(const ChildResult& result, std::string_view output,
                             const Confinement& confinement);
// Of one that said this.
std::string describe_failure(std::string_view output, const Confinement& confinement);

// The same failure where there is room for the frame, and else one of the disk that names both: of
// a file that it has no room for POV-Ray says "Cannot access data in file." and removes it.
LaunchFailure blame_full_disk(LaunchFailure failure, const LaunchPlace& place);

// The most that a frame of POV-Ray's takes in any file type, bytes.
constexpr std::uintmax_t frame_bytes(int width, int height) {
    constexpr std::uintmax_t bytes_per_pixel = 16;  // four floats
    constexpr std::uintmax_t header_bytes = 16 << 10;
    return static_cast<std::uintmax_t>(width) * static_cast<std::uintmax_t>(height) *
               bytes_per_pixel +
           header_bytes;
}

}  // namespace mpipov
