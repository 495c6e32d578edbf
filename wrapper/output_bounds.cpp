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

fs::path real(const fs::path& path) {
    std::error_code error;
    return fs::weakly_canonical(fs::absolute(path, error), error);
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

    // A device or a stream.
    bool names(const fs::path& file) const {
        std::error_code error;
        const fs::path named = fs::absolute(file, error).lexically_normal();
        return std::ranges::find(devices_, named) != devices_.end();
    }

    bool hold(const fs::path& target) const {
        const auto in = [&](const fs::path& folder) { return lies_in(target, folder); };
        return std::ranges::any_of(allowed_, in) ||
               std::ranges::any_of(folders_, [&](const fs::path& folder) {
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
        // Not all of /dev for one of it, nor what it links to: /dev/fd/5 leads to what has no name.
        if (lies_in(file, "/dev"))
            devices_.push_back(file);
        else
            add(fs::is_directory(file, error) ? file : file.parent_path());
    }

    fs::path home_;
    std::vector<fs::path> folders_, allowed_, devices_;
};

}  // namespace

void require_within_bounds(const OutputPlace& place, const Options& options,
                           const FolderRequest& user) {
    if (options.confine == Confining::off) return;
    const Bounds bounds(options, user);
    for (const fs::path& file : {place.image(), place.record(), place.work_folder()}) {
        if (bounds.names(file)) continue;
        const fs::path target = real(end_of_links(file));
        if (!bounds.hold(target))
            throw Failure(Exit::usage,
                          fmt::format("'{}' is not written: it lies in no folder that the command "
                                      "line names. Name it with +O, or allow it with --allow-write",
                                      target.string()));
    }
}

}  // namespace mpipov
