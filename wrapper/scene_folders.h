// Which folders a scene may be read from, by the command line: what the user named himself.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mpipov {

struct FolderRequest {
    std::vector<std::string> arguments;  // POV-Ray's
    std::filesystem::path run_folder;    // names are seen from it
    std::filesystem::path home;          // of the user; may be empty
    std::filesystem::path settings;      // the user's own povray.ini; may be empty
};

// The folders of the files that the arguments name, the folder of the run, and the library paths of
// the arguments and of the user's own povray.ini; each with all that is in it. But of a folder that
// is_for_more_than_a_scene() only those files whose name ends as POV-Ray's files do, and nothing
// where no file in it is named. Reads folders; what is missing is left out.
std::vector<std::filesystem::path> scene_folders(const FolderRequest& request);

// The home folder and what it is in, and folders that everybody may write to (/tmp).
bool is_for_more_than_a_scene(const std::filesystem::path& folder,
                              const std::filesystem::path& home);

// The library paths that an argument or a line of an INI file names: +Lfolder, Library_Path=folder.
std::vector<std::string> library_paths_in(std::string_view option);

// Those of all lines of an INI file, as they stand there; none where it cannot be read.
std::vector<std::string> library_paths_of(const std::filesystem::path& ini);

// The radiosity cache that it names: +RFfile, Radiosity_File_Name=file.
std::vector<std::string> caches_in(std::string_view option);

}  // namespace mpipov
