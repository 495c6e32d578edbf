// The coordinating half of the protocol: hands sections out, places what comes back, checks the
// overlaps and renders seams again where they disagree. Knows no MPI, no processes and no clock of
// its own; it is driven by handle() and never blocks.
#pragma once

#include "journal.h"
#include "overlap.h"
#include "povray_command.h"
#include "run_record.h"
#include "schedule.h"
#include "shipped_scene.h"
#include "stitch.h"
#include "transport.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mpipov {

struct CoordinatorSetup {
    Partition partition;
    Policy policy = Policy::dynamic;
    JobCommand job;
    ImageSize image;
    std::vector<RankRecord> ranks;  // slots 0: renders nothing
    std::vector<int> in_flight;     // launches under way at most, by rank
    int retries = 2;
    std::optional<double> timeout_seconds;
    std::vector<double> costs;        // expected, of each section, in any unit; empty: by area
    double copies_every_seconds = 1;  // how often idle ranks look for a section to copy
    int widest_halo = 32;             // a seam whose overlap still disagrees then is left as it is
    std::string cache = {};           // of radiosity, which every launch reads; empty: none
    bool gathers = false;             // what comes back are radiosity samples, and no pixels
    ShippedScene shipped = {};        // to ranks that do not have it
};

// Of a finished section, for the journal; Coordinator::resume() takes it back.
nlohmann::json about_section(const SectionRecord& record);

class Coordinator {
  public:
    // `clock` gives seconds since the run began, and may jump (never_back.h); `journal` may be
    // null.
    Coordinator(CoordinatorSetup setup, Transport& transport, Canvas& canvas, Journal* journal,
                std::function<double()> clock);

    // What the pixels of a section take; none where there is no such section.
    std::optional<std::uintmax_t> bytes_of(int section) const;
    // A section that an earlier run finished; before start().
    void resume(int section, const nlohmann::json& about, std::span<const std::byte> pixels);

    void start();
    // Throws Failure where a section failed once too often, std::runtime_error where a message is
    // not what the protocol allows.
    void handle(const Message& message);
    // To be called now and then: lets idle ranks copy the section that would end last.
    void tick();
    bool finished() const { return schedule_.all_finished(); }
    // Once finished: puts the seams that were rendered again into the canvas, in an order that does
    // not depend on which rank was first.
    void place_repairs();
    // Once finished, where it gathers: what each section took, by id.
    std::vector<std::string> samples() const;

    // Of the region's pixels, those rendered so far; sections under way count by their progress.
    // From 0 to 1, and never less than before: a section that failed or a seam that is rendered
    // again only holds it up.
    double fraction() const;
    const std::string& host(int rank) const {
        return setup_.ranks.at(static_cast<std::size_t>(rank)).host;
    }
    int sections_done() const { return sections_done_; }
    int sections_total() const { return static_cast<int>(sections_.size()); }

    // Sections, seams, ranks, totals and warnings; the rest is the caller's.
    void fill(RunRecord& record) const;

  private:
    // A launch that renders a section; there are two where one is a copy.
    struct Run {
        int rank = -1, attempt = 0;
        double start = 0;     // seconds since the run began
        double fraction = 0;  // of the section, that POV-Ray has told of
    };
    struct Progress {
        SectionRecord record;
        int seam = -1;          // >= 0: this section renders that seam again
        std::vector<Run> runs;  // under way; one alone has sent bands
        double fraction = 0;
        int next_row = 0;                 // where the next band of this attempt begins
        SeamRecord disagreement;          // of a seam rendered again with its surroundings
        std::vector<std::byte> repaired;  // its pixels
        std::string samples;              // of this attempt, where it gathers
    };

    // Where the message comes from; `run` is null where that launch was told to end.
    struct Source {
        Progress* progress = nullptr;
        Run* run = nullptr;
    };

    void feed_caches();
    void assign_to(int worker);
    void assign_to_all();
    void begin(int section, int worker);
    void end_launch(int worker, double cpu_seconds);
    Outlook outlook(int section, int worker) const;
    double cost_of(int section) const;
    std::optional<double> expected_seconds(int section, int worker) const;
    void learn(const SectionRecord& record);
    void correct_neighbours(int section);
    void keep_only(Progress& progress, const Run& winner);
    void take_end_of_loser(const Message& message);
    void take_progress(const Message& message);
    void take_band(const Message& message);
    void take_samples(const Message& message);
    void take_repair_band(Progress& progress, const Rect& rect, std::span<const std::byte> pixels);
    void take_done(const Message& message);
    void take_failed(const Message& message);
    void check_seam(int seam);
    void check_repair(Progress& repair);
    void repair(int seam, int too_small);
    Source source_of(const Message& message);
    void set_fraction(Progress& progress, double fraction);

    CoordinatorSetup setup_;
    Transport& transport_;
    Canvas& canvas_;
    Journal* journal_;
    std::function<double()> clock_;
    Schedule schedule_;
    OverlapCheck overlap_;
    std::vector<Progress> sections_;  // by id
    std::vector<SeamRecord> seams_;
    std::vector<std::size_t> fed_;         // bytes of the cache that were sent, by rank
    std::vector<int> under_way_;           // launches, by rank
    std::vector<double> busy_since_;       // by rank
    std::set<std::array<int, 3>> losers_;  // section, attempt, rank: launches told to end
    // Wall seconds of finished launches and the costs of their sections, by rank.
    struct Pace {
        double seconds = 0, cost = 0;
    };
    Pace pace_of_all() const;
    std::vector<Pace> pace_;
    double looked_for_copies_ = 0;              // when, seconds
    std::vector<std::vector<int>> neighbours_;  // by section; with Policy::cost
    Totals totals_;
    std::vector<std::string> warnings_;
    int sections_done_ = 0;
    double pixels_ = 0, pixels_done_ = 0;
    double furthest_ = 0;  // the largest fraction so far
};

}  // namespace mpipov
