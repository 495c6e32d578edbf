// All that `mpipov-validate tradeoff` measured: tradeoff.json, a table, a sentence.
//
// Errors are RMS over all pixels and the three colour channels of display-encoded (sRGB) values, in
// levels of 255, taken from renders of 16 bits so that rounding to 8 does not hide what is smaller
// than a level. Wall seconds are from start to end of a command, CPU seconds those of all of its
// processes: POV-Ray's own process of a serial render, all launches and the coordinator of a run of
// mpipov.
#pragma once

#include "image_source.h"
#include "speedup_table.h"
#include "ssim.h"
#include "tradeoff_front.h"
#include "tradeoff_settings.h"
#include "tradeoff_truth.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct TradeoffError {
    double rms = 0, largest = 0;  // levels of 255
    bool identical = false;
    Ssim ssim;
};

struct TradeoffRow {
    TradeoffSetting setting;
    std::vector<std::string> argv;       // as run, but for the names of what it writes
    std::vector<std::string> user_argv;  // what a user would run
    std::vector<double> wall, cpu;       // seconds, by repetition
    std::string failure;                 // empty: none. After one it is not tried again.
    bool impossible = false;             // mpipov refused it: there is no such grid
    std::filesystem::path image;         // of the first repetition
    std::string pixel_sha1;              // of that
    bool varies = false;                 // a later repetition gave other pixels
    int sections = 0;                    // that mpipov really made
    std::optional<TradeoffError> truth, serial;

    bool measured() const { return failure.empty() && !wall.empty(); }
};

struct TradeoffPick {
    std::string limit;               // "--max-error", "--max-seconds"
    double value = 0;                // levels of 255; wall seconds
    std::optional<std::size_t> row;  // none: no setting fits
};

// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON only asserts
struct TradeoffReport {
    std::filesystem::path folder;  // paths in the JSON are relative to it
    std::vector<std::string> arguments;
    std::map<std::string, std::string> versions;
    int cores = 0;
    std::string cpu;
    std::string scene, file;
    nlohmann::json identity;  // of the job: what must be the same to go on (job_identity.h)
    SceneCalls calls;
    std::map<std::string, bool> effects;
    int width = 0, height = 0;  // of the whole image
    Rect region;                // what of it is rendered
    std::optional<ImageFormat> image;
    int ranks = 0, repeat = 0;
    Averaging averaging = Averaging::linear;
    std::optional<Truth> truth;
    double truth_share = 0.1;   // of the best error that the truth's own may be
    std::string truth_stopped;  // why its own error is more; empty: it is not
    // Of the best setting against a truth that was averaged the other way.
    std::optional<double> other_averaging_error;
    std::vector<TradeoffRow> rows;
    std::vector<LeftOut> left_out;
    std::vector<TradeoffPick> picks;
    std::vector<std::string> notes;
    bool complete = false;
    std::string failure;  // what stopped all; empty: nothing
};

// Median seconds and error against truth of each row; none where either is not known.
std::vector<std::optional<TradeoffPoint>> points_of(const TradeoffReport& report, bool wall);
// The smallest error against truth; none where there is none.
std::optional<std::size_t> most_accurate(const TradeoffReport& report);
// Of the front by wall or CPU seconds.
std::optional<TradeoffLaw> law_of(const TradeoffReport& report, bool wall);

nlohmann::json to_json(const TradeoffReport& report);
// Why nothing of an earlier tradeoff.json can be gone on from: the first thing that is another now;
// "" where nothing is. Throws json's exceptions where it is damaged, as the next one does.
std::string what_changed_since(const TradeoffReport& report, const nlohmann::json& earlier);
// Takes over from an earlier tradeoff.json what is still true of the rows and of the truth: those
// with the same argv, whose images are there.
void take_measured(TradeoffReport& report, const nlohmann::json& earlier);

std::string to_table(const TradeoffReport& report);
// "Halving the error costs 2.1 times the CPU time ...": one sentence.
std::string law_sentence(const TradeoffReport& report);
// For a shell.
std::string shell_line(const std::vector<std::string>& argv);

}  // namespace mpipov
