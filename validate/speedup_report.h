// All that `mpipov-validate speedup` measured, as JSON (speedup.json) and as tables in the form of
// the 1999 paper's: a line for each way to render, a column for each number of processors.
// Times are wall seconds from start to end of the command, all that belongs to it included.
#pragma once

#include "image_source.h"
#include "speedup_table.h"
#include "speedup_variants.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

// Of the image of one variant, against the first serial one.
struct SpeedupDifference {
    long long differing = 0;        // pixels; 0: identical
    std::optional<double> largest;  // in stored units, none where nothing finite differs
};

struct SpeedupPlan {
    int sections = 0, threads = 0, in_flight = 0;  // that mpipov chose
};

struct SpeedupRow {
    SpeedupVariant variant;
    std::vector<std::string> argv;
    Times times;          // one entry for each repetition that was begun
    std::string failure;  // empty: none. After a failure it is not tried again.
    std::optional<SpeedupDifference> difference;  // the worst of all repetitions
    std::optional<SpeedupPlan> plan;              // of the last run
    std::filesystem::path record;                 // of the last run; empty: none
};

struct SpeedupRepetition {
    std::vector<std::string> order;  // names of what was run, in turn
    std::optional<double> load;      // the host's load average (1 minute) before it
};

struct SpeedupReport {
    std::filesystem::path folder;  // paths in the JSON are relative to it
    std::vector<std::string> arguments;
    std::map<std::string, std::string> versions;
    int cores = 0;    // that this program may use
    std::string cpu;  // as Linux calls it
    std::string scene, file;
    bool order_dependent = false;
    std::optional<ImageFormat> image;
    int repeat = 0;  // repetitions asked for
    bool complete = false;
    std::string failure;           // what stopped all; empty: nothing
    std::vector<SpeedupRow> rows;  // the serial one first
    std::vector<SpeedupRepetition> repetitions;
};

nlohmann::json to_json(const SpeedupReport& report);

std::string to_table(const SpeedupReport& report);

}  // namespace mpipov
