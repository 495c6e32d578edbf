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

// Of the user who runs us, in his current folder.
FolderRequest request_of_user(std::vector<std::string> arguments);

// The folders of the files that the arguments name, the folder of the run, and the library paths of
// the arguments and of the user's own povray.ini; each with all that is in it. But of a folder that
// is_for_more_than_a_scene() only those files whose name ends as POV-Ray's files do, and nothing
// where no file in it is named. A radiosity cache that they name is the file alone. Reads folders;
// what is missing is left out.
std::vector<std::filesystem::path> scene_folders(const FolderRequest& request);

// Whether `file`, links followed, is one of these or lies in one: the one rule by which a scene may
// read it. Of a file that is not there: whether it might be read if it were.
bool may_be_read(const std::filesystem::path& file,
                 const std::vector<std::filesystem::path>& readable);

// By its name: what scenes read, which is themselves, includes, images, fonts and densities.
bool is_a_scenes_file(const std::filesystem::path& file);

// The home folder and what it is in, and folders that everybody may write to (/tmp).
bool is_for_more_than_a_scene(const std::filesystem::path& folder,
                              const std::filesystem::path& home);

// The library paths that an argument or a line of an INI file names: +Lfolder, Library_Path=folder.
std::vector<std::string> library_paths_in(std::string_view option);

// Those of all lines of an INI file, as they stand there; none where it cannot be read.
std::vector<std::string> library_paths_of(const std::filesystem::path& ini);

// The radiosity cache that it names: +RFfile, Radiosity_File_Name=file.
std::vector<std::string> caches_in(std::string_view option);

// Where the image is to go: +Ofile, Output_File_Name=file; of an option, and of an INI file.
std::vector<std::string> outputs_in(std::string_view option);
std::vector<std::string> outputs_of(const std::filesystem::path& ini);

}  // namespace mpipov
