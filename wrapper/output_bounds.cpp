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
        const auto in = [&](const fs::path& folder) { return lies_in(target, folder); };
        return allow(target) || std::ranges::any_of(folders_, [&](const fs::path& folder) {
                   return is_for_more_than_a_scene(folder, home_)
                              ? target.parent_path() == folder &&
                                    !target.filename().string().starts_with('.')
                              : in(folder);
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

[[noreturn]] void refuse(const fs::path& target, const char* why) {
    throw Failure(Exit::usage, fmt::format("'{}' is not written: {} with +O, or allow it with "
                                           "--allow-write",
                                           target.string(), why));
}

}  // namespace

void require_within_bounds(const OutputPlace& place, const Options& options,
                           const FolderRequest& user) {
    if (options.confine == Confining::off) return;
    const Bounds bounds(options, user);
    std::vector<fs::path> targets{place.image(), place.record(), place.work_folder()};
    // A scene may bring a work folder to go on from.
    std::error_code error;
    for (fs::directory_iterator it(place.work_folder(), error);
         !error && it != fs::directory_iterator(); it.increment(error))
        if (it->is_symlink()) targets.push_back(it->path());
    for (const fs::path& file : targets) {
        if (is_written_into(file)) {
            // It is not opened for a look where it leads: /dev/fd/5 is a link to what has no name.
            std::error_code ignored;
            const bool device = lies_in(fs::absolute(file, ignored).lexically_normal(), "/dev");
            if (bounds.name(file) && (device || !fs::is_symlink(file))) continue;
            if (bounds.allow(real(file))) continue;
            refuse(file, "it is a pipe or a device that the command line does not name. Name it");
        }
        const fs::path target = real(end_of_links(file));
        if (!bounds.hold(target))
            refuse(target, "it lies in no folder that the command line names. Name it");
    }
}

}  // namespace mpipov
