// run.json: what one run did, as mpipov writes it and mpipov-validate reads it.
// Times are seconds; `start` and `end` count from the start of the run on the coordinator's
// monotonic clock. Rectangles are half-open pixels, 0-based from the top left.
#pragma once

#include "radiosity_sharing.h"
#include "section.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

struct Effect {
    bool on = false;
    std::string why;                    // what POV-Ray printed that says so
    std::optional<double> cpu_seconds;  // what it costs in the whole render, where known
};

struct ImageInfo {
    int width = 0, height = 0, channels = 0;
    std::string type;   // as OpenImageIO names it: png, openexr, hdr, jpeg, targa, bmp, pnm
    std::string depth;  // uint8, uint16, half, float
};

struct Predicted {
    double wall_seconds = 0, cpu_seconds = 0;
};

struct PlanRecord {
    ImageInfo image;
    Rect region;
    std::map<std::string, Effect> effects;
    Shape shape = Shape::columns;
    Seams seams = Seams::aligned;
    int halo = 0, block = 32, sections = 1;
    // What each section keeps, where they are no regular grid (cut_by_cost); empty: they are.
    std::vector<Rect> cuts;
    RadiositySharing radiosity;
    std::string schedule;
    int threads = 1, in_flight = 1;
    Predicted predicted;
};

struct RankRecord {
    int rank = 0;
    std::string host;
    int slots = 1;
    int sections = 0;         // how many it rendered
    double busy_seconds = 0;  // wall seconds with at least one launch under way
};

struct SectionRecord {
    Section section;
    int rank = -1;
    std::string host;
    double start = 0, end = 0;  // seconds since the run began
    double wall_seconds = 0;    // of the launch that counted
    double cpu_seconds = 0;     // of the launch that counted: user + system
    int attempts = 0;
    bool resumed = false;  // taken from an earlier run's journal
};

struct SeamRecord {
    Seam seam;
    bool checked = false;     // two sections rendered the overlap and were compared
    long long differing = 0;  // pixels of the overlap on which they disagree
    // In the file's own units: levels of 8/16 bit, or float values. Infinite, in JSON null, where
    // one of the two is no finite number.
    double max_difference = 0;
    int halo = 0;  // overlap at the end, wider than the plan's where it was widened
};

struct Totals {
    double wall_seconds = 0;
    double cpu_seconds = 0;              // of all POV-Ray launches, probes included
    double coordinator_cpu_seconds = 0;  // rank 0's own process: coordinating, stitching, encoding
    int launches = 0, retries = 0;
    int copies = 0;  // launches of a section that was under way elsewhere
};

// Sections that gathered radiosity samples side by side (radiosity_sharing.h).
struct WaveRecord {
    int width = 0, height = 0;            // of the render that they are sections of
    long long samples = 0;                // in the cache, once theirs were joined
    std::vector<SectionRecord> sections;  // rectangles in pixels of that render
};

struct RunRecord {
    bool complete = false;
    std::map<std::string, std::string> versions;  // mpipov, povray, mpi, openimageio
    std::vector<std::string> command;             // mpipov's own argv
    std::string started;                          // UTC, ISO 8601
    std::filesystem::path output;
    std::string scene_sha1;  // of the SHA-1s of the files that the scene is made of
    std::string pixel_sha1;  // of the pixels in row order, little-endian, channels interleaved
    PlanRecord plan;
    std::vector<RankRecord> ranks;
    std::vector<SectionRecord> sections;
    std::vector<WaveRecord> waves;  // before the sections; not those of an earlier run
    std::vector<SeamRecord> seams;
    std::vector<SectionRecord> repairs;  // seams that were rendered again, over the sections
    Totals totals;
    std::vector<std::string> warnings;  // POV-Ray's own, each once
};

nlohmann::json to_json(const PlanRecord& plan);
nlohmann::json to_json(const RunRecord& record);

// Throws std::runtime_error, naming what is missing or of the wrong kind.
PlanRecord plan_from_json(const nlohmann::json& json);
RunRecord run_from_json(const nlohmann::json& json);

// Throws std::runtime_error with the file's name.
RunRecord read_run_record(const std::filesystem::path& file);
// As write_whole(): a reader never sees half a record.
void write_run_record(const std::filesystem::path& file, const RunRecord& record);

}  // namespace mpipov
