// The launches of a probe, side by side: what they are and when they have said enough.
#pragma once

#include "povray_command.h"
#include "short_launch.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mpipov {

// What the probe's own renders show of the image.
struct ProbeView {
    ImageSize size;  // +W +H of the render, pixels
    // Only this part of it, empty: all.
    Rect area;
};

// The whole picture, small. The size is the one that the arguments name last, or POV-Ray's own
// default: POV-Ray itself is asked for the real one at the same time.
ProbeView small_view(const std::vector<std::string>& user_arguments);

// The middle of the picture in its own size, for a scene that refuses to be rendered small
// (`#if (image_width < 320) #error ...`).
ProbeView middle_view(const ImageSize& image);

struct ProbeRequest;  // probe.h

// What makes the user's command a render of that view; without the antialiasing where it is plain.
std::vector<std::string> view_arguments(const ProbeView& view, bool plain);

// The whole argv of a small launch: the user's arguments, `more`, and what all of ours have.
std::vector<std::string> small_command(const ProbeRequest& request,
                                       const std::vector<std::string>& more);

// The seconds after which a small render counts as hung, where the user did not say: a scene may
// take long to be parsed.
double small_timeout(const ProbeRequest& request);

// A small launch in `folder`, confined; `pixels` of the frame that it writes, see LaunchNeeds.
ChildRequest small_request(const ProbeRequest& request, const std::filesystem::path& folder,
                           std::vector<std::string> argv, std::optional<std::uint64_t> pixels);

// The file without its extension that the launch in this folder writes.
std::filesystem::path small_image(const std::filesystem::path& folder);

class ProbeLaunches {
  public:
    // Starts the launch that resolves the user's own command.
    explicit ProbeLaunches(const ProbeRequest& request);

    // Starts the renders of one view, instead of those of an earlier one.
    void render(const ProbeView& view);

    // Until all have done their work, or one has failed. Throws Failure(Exit::interrupted).
    void wait();

    // The text of the launch that resolves; whether it came as far as the scene's first line.
    std::string_view resolve_output() const { return launches_.front().child.output(); }
    bool resolved() const;
    bool started() const;  // POV-Ray could be started at all, or has not ended yet
    std::filesystem::path settings_file() const;  // in the folder of the launch that resolves

    // Of the render in POV-Ray's own order.
    bool rendered() const { return launches_.at(1).succeeded(); }
    // The scene's own #error, or what it computes from its size; not that the machine is too busy.
    bool refused_by_the_scene() const;
    std::string_view render_output() const { return launches_.at(1).child.output(); }
    // Of the same without antialiasing.
    std::string_view plain_output() const { return launches_.at(2).child.output(); }

    // The files. Throw Failure(Exit::scene), saying why, where there is none.
    std::filesystem::path sample() const;
    // Of one and the same picture, without antialiasing. Only the first one where there is
    // radiosity: its samples are taken in the order of rendering, and that is known.
    std::vector<std::filesystem::path> in_several_orders() const;
    // The radiosity samples of the first one, as POV-Ray writes them; empty without radiosity.
    // Throws as read_new_samples().
    std::string radiosity_cache() const;

    int count() const { return started_; }  // all that were ever started
    double cpu_seconds() const;

  private:
    void start(const std::string& name, const std::vector<std::string>& more,
               const std::vector<std::string>& last = {});
    bool takes_radiosity_samples() const;
    void end_other_orders();
    std::filesystem::path image_of(const ShortLaunch& launch) const;

    const ProbeRequest& request_;
    std::vector<ShortLaunch> launches_;
    std::filesystem::path cache_;  // of the launch in the first order
    // Of the frame that its renders write; that of the launch that resolves is the user's.
    std::optional<std::uint64_t> pixels_ = {};
    int started_ = 0, views_ = 0;
    bool radiosity_told_ = false;
    double earlier_cpu_seconds_ = 0;
};

}  // namespace mpipov
