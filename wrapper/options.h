// mpipov's command line. One table of options serves parsing, --help and the manual page.
#pragma once

#include "radiosity_sharing.h"
#include "schedule.h"
#include "section.h"
#include "shipped_scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace mpipov {

enum class ProgressStyle { automatic, plain, none };

// Where a kernel cannot keep POV-Ray from files: automatic goes on, on refuses.
enum class Confining { automatic, on, off };

struct SizeLimit {
    bool automatic = true;
    std::optional<std::uint64_t> bytes;  // where not automatic; none: no limit
};

struct Options {
    Policy schedule = Policy::dynamic;
    std::optional<int> sections;
    std::optional<Shape> shape;
    std::optional<Seams> seams;
    int halo = 2;
    std::optional<Sharing> radiosity;
    int radiosity_passes = 1;
    std::optional<int> radiosity_scale;
    std::optional<int> threads;
    std::optional<int> in_flight;
    std::optional<int> slots;
    bool dedicated_coordinator = false;
    Ship ship = Ship::automatic;
    std::filesystem::path work_dir;  // empty: beside the output
    bool resume = false;
    std::optional<double> timeout_seconds;
    int retries = 2;
    double lost_after_seconds = 15;
    bool dry_run = false;
    ProgressStyle progress = ProgressStyle::automatic;
    Confining confine = Confining::automatic;
    std::vector<std::filesystem::path> allow_read, allow_write;
    SizeLimit memory_limit, disk_limit;  // of a launch
    std::filesystem::path record;        // empty: run.json beside the output
    std::string povray = "povray";

    bool help = false, version = false, manual = false;
    std::vector<std::string> povray_arguments;  // everything that is not ours, in order
};

// Every argument that begins with `--` is ours (its value after `=` or as the next argument), all
// others are POV-Ray's; after a lone `--` everything is. Throws Failure(Exit::usage).
Options parse_options(const std::vector<std::string>& arguments);

// Those of "What a scene may do" (--allow-read ... --disk-limit), for another program that starts
// POV-Ray: from the same table. While `app` parses they are set in `options`, and put into `given`
// as mpipov takes them. Both must outlive that.
void add_keeping_options(CLI::App& app, Options& options, std::vector<std::string>& given);

std::string help_text();
std::string manual_page();  // troff, for man(1)

}  // namespace mpipov
