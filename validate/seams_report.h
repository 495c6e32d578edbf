// All that `mpipov-validate seams` found out about a scene, as JSON (seams.json) and as a table.
// Errors are in stored units, as in compare_report.h; null stands for what is undefined.
#pragma once

#include "compare.h"
#include "run_record.h"
#include "seam_verdict.h"
#include "serial_set.h"
#include "stability_report.h"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct SeamsCase {
    std::string name;
    std::string schedule;
    int ranks = 1;
    Shape shape = Shape::columns;
    Seams seams = Seams::aligned;
    int halo = 0, sections = 1;      // as asked for
    std::string radiosity = "auto";  // the same
    std::string failure;             // empty: none
    std::filesystem::path image, run_file;
    std::string reference;  // "default" or "oneblock"
    std::optional<RunRecord> run;
    std::optional<Comparison> comparison;
    std::optional<Judgement> judgement;
    Verdict verdict;
    double seconds = 0;
};

struct SkippedCase {
    std::string name, why;
};

// How well-conditioned the scene is.
struct SeamsScene {
    Stability found;
    std::string failure;  // not empty: it could not be measured
};

struct SeamsReport {
    std::filesystem::path folder;  // paths in the JSON are relative to it
    std::vector<std::string> arguments;
    std::map<std::string, std::string> versions;
    bool complete = false;
    std::string failure;
    std::map<std::string, Effect> effects;
    std::optional<ImageFormat> image;
    std::optional<SerialSet> serial;         // none: it was not come so far
    std::optional<SeamsScene> conditioning;  // none: nothing was to be blamed
    std::vector<SeamsCase> cases;
    std::vector<SkippedCase> skipped;  // that cannot be: so many sections, so few columns
};

nlohmann::json to_json(const SeamsReport& report);

std::string to_table(const NoiseReport& noise, const std::string& unit);
std::string to_table(const SeamsReport& report);

}  // namespace mpipov
