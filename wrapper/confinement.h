// What every launch of POV-Ray may do. A scene is a program of somebody else's: it reads what its
// user named and POV-Ray's own files, writes into its launch's folder, starts nothing, and takes
// so much memory and disk space. docs/security.md says what of this holds where.
#pragma once

#include "child_process.h"
#include "options.h"
#include "scene_writes.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mpipov {

// What of this machine is shared by the launches.
struct HostResources {
    std::uint64_t memory_bytes = 0;  // that processes may use
    int cores = 1;                   // that launches use at once
};
// `cores` are those of the ranks on this host.
HostResources resources_of_host(int cores);

// A launch: what it runs, the folder that is its own, what it needs.
struct LaunchNeeds {
    std::vector<std::string> argv;
    std::filesystem::path folder;  // its images and temporary files; nothing else is written
    std::optional<double> timeout_seconds = {};
    int threads = 1;
    // Of the image that it writes a frame of: POV-Ray keeps a large one in a file with holes, which
    // is as long as all of it.
    std::optional<std::uint64_t> pixels = 0;           // not known: a file may have any length
    std::vector<std::filesystem::path> reads = {};     // besides the scene's
    std::vector<std::filesystem::path> executes = {};  // besides POV-Ray; to read too
};

// A scene that was sent to this host.
struct SceneCopy {
    std::filesystem::path root;          // all of it lies below
    std::filesystem::path run_folder;    // where POV-Ray runs
    std::filesystem::path settings;      // its povray.ini
    std::vector<std::string> arguments;  // POV-Ray's
    bool operator==(const SceneCopy&) const = default;
};

class Confinement {
  public:
    // None: POV-Ray as it is.
    Confinement() = default;

    // By the command line and this process's own environment and folder. `own` is a folder of the
    // run's, where POV-Ray's configuration is put. Throws Failure: usage where --confine on is
    // asked for and the kernel cannot, or what is to be allowed is not there; file where `own`
    // cannot be written.
    Confinement(const Options& options, const HostResources& host,
                const std::filesystem::path& own);

    // The same for a scene that was sent here: what its user named lies in the copy, nothing else
    // of this host is the scene's.
    Confinement in_copy(const SceneCopy& copy) const;

    // The only way in which mpipov starts POV-Ray with a scene. A scene that writes files runs in a
    // folder of its launch that looks like ours. Throws std::filesystem::filesystem_error.
    ChildRequest request(LaunchNeeds needs) const;

    // Whether files are out of its reach: not where the kernel cannot, nor with --confine off.
    bool restricts_files() const { return files_.has_value(); }

    // Whether a scene may read a file or folder, links followed: what else it names is not its own,
    // and is not for other hosts either.
    bool may_read(const std::filesystem::path& path) const;

    // What the user should know before he waits for the image; empty: nothing.
    std::string note() const;

    // Whether a file, links followed, is one that the user named, or lies in a folder that he named
    // (scene_folders.h, --allow-read): what a launch reads besides the system's, and all of it that
    // may leave this host. The same with --confine off.
    bool is_users(const std::filesystem::path& file) const;

    // What a user can do about a launch that failed with this text of POV-Ray's: a sentence in
    // parentheses with a blank before it where a limit of ours was the cause, else empty.
    std::string way_out(std::string_view error) const;

  private:
    void search(const std::filesystem::path& run_folder, const std::vector<std::string>& arguments);
    std::uint64_t memory_limit(int threads) const;
    std::optional<std::uint64_t> file_limit(const LaunchNeeds& needs) const;
    std::optional<std::uint64_t> folder_limit(const LaunchNeeds& needs) const;
    std::string way_to_read(const std::string& name) const;
    std::string way_to_write(const std::string& name) const;

    bool on_ = false, off_ = false;  // limits at all; files left alone because the user says so
    std::string program_name_;       // --povray
    std::filesystem::path program_file_;  // found for it here; empty: none
    FileAccess program_;                  // what any scene may
    std::optional<FileAccess> files_;
    std::vector<std::filesystem::path> users_;  // see is_users()
    std::filesystem::path home_;                // the user's
    std::filesystem::path run_folder_;          // of a copy; empty: ours
    std::vector<std::pair<std::string, std::string>> environment_;
    std::vector<std::filesystem::path> searched_;  // for names that are relative
    SceneWrites writes_;
    SizeLimit memory_, disk_;
    HostResources host_;
};

}  // namespace mpipov
