// The rendering half of the protocol: keeps launches of POV-Ray under way, reads what they wrote
// and sends it to the coordinator: pixels, or the radiosity samples where the job is to gather
// those. Single-threaded; step() never blocks for long.
#pragma once

#include "cache_stream.h"
#include "child_process.h"
#include "confinement.h"
#include "end_of_work.h"
#include "failure.h"
#include "image_file.h"
#include "launch_failure.h"
#include "povray_command.h"
#include "prepared_launch.h"
#include "received_scene.h"
#include "section.h"
#include "transport.h"

#include <poll.h>

#include <filesystem>
#include <list>
#include <optional>
#include <string>
#include <vector>

namespace mpipov {

class Worker {
  public:
    // Section files lie in `scratch` while they are needed. `confinement`: of every launch.
    Worker(Transport& transport, std::filesystem::path scratch, Confinement confinement = {});

    void handle(const Message& message);

    const std::filesystem::path& scratch() const { return scratch_; }
    const Confinement& confinement() const { return confinement_; }

    // A launch that is under way already: the first attempt at `section` takes it, and its time
    // runs from then on.
    void adopt(int section, PreparedLaunch launch);

    // Looks after the launches; true where something happened.
    bool step();

    bool stopped() const { return stopped_; }

    // What ::poll() may sleep on, and for how long at most (milliseconds) if there are launches.
    void add_poll_fds(std::vector<pollfd>& fds) const;
    int wait_milliseconds(int at_most) const;

    // Ends every launch at once; nothing of them is left.
    void stop();

  private:
    struct Launch {
        Section section;
        int attempt = 0;
        LaunchFolder folder;  // before the child, which must be gone when it is removed
        ChildProcess child;
        EndOfWork end = {};
        // Once POV-Ray has done its work, one of them: its image, or the samples that it gathered.
        std::optional<SectionReader> reader = {};
        std::optional<std::string> samples = {};
        std::size_t samples_sent = 0;
        std::string broken = {};  // why what it made could not be read; it has not ended
        Exit code = Exit::scene;  // what that is
        double last_fraction = 0;
        bool cancelled = false;  // another rank was first

        bool sends() const { return reader || samples; }
    };
    enum class State { busy, idle, over };

    void take_job(const nlohmann::json& head);
    void confine_launches(std::optional<SceneCopy> copy);
    void take_scene(const Message& message);
    void start(const Message& message);
    PreparedLaunch launch(const Section& section, int attempt);
    State step(Launch& launch);
    void cancel(const Message& message);
    State end_cancelled(Launch& launch);
    State begin_reading(Launch& launch);
    State end_broken(Launch& launch);
    State send_more(Launch& launch);
    State send_done(const Launch& launch);
    void send_progress(Launch& launch);
    LaunchPlace place_of(const Launch& launch) const;
    void send_failure(const Launch& launch, const LaunchFailure& failure);
    nlohmann::json head_of(const Launch& launch) const;

    Transport& transport_;
    std::filesystem::path scratch_;
    Confinement confinement_;
    Confinement launch_confinement_;  // of the job: the same, or in a copy of the scene
    std::optional<SceneCopy> copy_;   // that it is in
    JobCommand job_;
    ImageSize image_;
    int jobs_ = 0;  // so far
    bool gathers_ = false;
    ReceivedCache cache_;  // of the job
    ReceivedScene scene_;
    std::optional<double> timeout_seconds_;
    std::list<Launch> launches_;
    std::list<PreparedLaunch> leaving_;  // have done their work, and sleep before they end
    std::optional<PreparedLaunch> adopted_;
    int adopted_for_ = -1;  // section
    bool stopped_ = false;
};

// The name of the file that a section's launch makes, but for its extension.
constexpr const char* section_image_name = "section";
// Where it gathers samples, with it.
constexpr const char* section_cache_name = "section.cache";

// The image that POV-Ray made of the output name `base`: it adds an extension that we do not know
// (and the number of a frame), and may put files of other names beside it (+GA). Throws
// std::runtime_error where there is none.
std::filesystem::path find_image(const std::filesystem::path& base);
// The same; nothing where there is none.
std::optional<std::filesystem::path> look_for_image(const std::filesystem::path& base);

}  // namespace mpipov
