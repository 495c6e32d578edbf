#include "output_bounds.h"

#include "failure.h"
#include "inside.h"
#include "part_file.h"
#include "scene_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <vector>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

// Of what cannot be looked at (a name that is too long), the path as it stands: it cannot be
// written either, and says so itself.
fs::path real(const fs::path& path) {
    std::error_code error;
    const fs::path full = fs::absolute(path, error);
    const fs::path found = fs::weakly_canonical(full, error);
    return error ? full.lexically_normal() : found;
}

class Bounds {
  public:
    Bounds(const Options& options, const FolderRequest& user) : home_(user.home) {
        add(user.run_folder);
        for (const std::string& argument : user.arguments) {
            for (const std::string& name : names_in_option(argument))
                add((user.run_folder / name).parent_path());
            for (const std::string& name : outputs_in(argument)) add_output(name);
        }
        if (!user.settings.empty())
            for (const std::string& name : outputs_of(user.settings)) add_output(name);
        for (const fs::path& own : {options.record, options.work_dir})
            if (!own.empty()) add_output(own);
        // Whatever these are.
        for (const fs::path& path : options.allow_write) allowed_.push_back(real(path));
    }

    // With or without the extension that POV-Ray puts behind it.
    bool name(const fs::path& file) const {
        std::error_code error;
        const fs::path full = fs::absolute(file, error).lexically_normal();
        return std::ranges::find(named_, full) != named_.end() ||
               std::ranges::find(named_, fs::path(full).replace_extension()) != named_.end();
    }

    bool allow(const fs::path& target) const {
        return std::ranges::any_of(allowed_,
                                   [&](const fs::path& folder) { return lies_in(target, folder); });
    }

    bool hold(const fs::path& target) const {
        return allow(target) || std::ranges::any_of(folders_, [&](const fs::path& folder) {
                   return is_for_more_than_a_scene(folder, home_)
                              ? target.parent_path() == folder &&
                                    !target.filename().string().starts_with('.')
                              : lies_in(target, folder);
               });
    }

  private:
    void add(const fs::path& folder) { folders_.push_back(real(folder)); }
    void add_output(const fs::path& name) {
        std::error_code error;
        const fs::path file = fs::absolute(name, error).lexically_normal();
        named_.push_back(file);
        // Not all of /dev for one of it.
        if (!lies_in(file, "/dev")) add(fs::is_directory(file, error) ? file : file.parent_path());
    }

    fs::path home_;
    std::vector<fs::path> folders_, allowed_, named_;
};

struct Target {
    fs::path file;
    const char* option;  // that names it
};

[[noreturn]] void refuse(const Target& target, const fs::path& file, const char* why) {
    throw Failure(Exit::usage, fmt::format("'{}' is not written: {}. Name it with {}, or allow it "
                                           "with --allow-write",
                                           file.string(), why, target.option));
}

}  // namespace

void require_within_bounds(const OutputPlace& place, const Options& options,
                           const FolderRequest& user) {
    if (options.confine == Confining::off) return;
    const Bounds bounds(options, user);
    const char* const of_work = "--work-dir";
    std::vector<Target> targets{
        {place.image(), "+O"}, {place.record(), "--record"}, {place.work_folder(), of_work}};
    // A scene may bring a work folder to go on from.
    std::error_code error;
    for (fs::directory_iterator it(place.work_folder(), error);
         !error && it != fs::directory_iterator(); it.increment(error))
        if (it->is_symlink()) targets.push_back({it->path(), of_work});
    for (const Target& target : targets) {
        const fs::path& file = target.file;
        const bool is_link = fs::is_symlink(file, error);
        if (is_written_into(file)) {
            // It is not opened for a look where it leads: /dev/fd/5 is a link to what has no name.
            const bool device = lies_in(fs::absolute(file, error).lexically_normal(), "/dev");
            if (bounds.name(file) && (device || !is_link)) continue;
            if (bounds.allow(real(file))) continue;
            refuse(target, file, "it is a pipe or a device that the command line does not name");
        }
        // Record and work folder are called after the image, and lie beside it.
        const bool beside =
            bounds.name(place.image()) && file.parent_path() == place.image().parent_path();
        if ((bounds.name(file) || beside) && !is_link) continue;
        const fs::path end = real(end_of_links(file));
        if (!bounds.hold(end))
            refuse(target, end, "it lies in no folder that the command line names");
    }
}

}  // namespace mpipov
