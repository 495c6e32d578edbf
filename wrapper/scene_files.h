// Which files a scene is made of, as far as its text says it: the scene itself, what it includes,
// the images, fonts and other files that it names, and the INI files of the command line.
//
// A file counts where its name stands as a string literal in the scene, in a file that counts, or
// as an option, and where a regular file of that name lies in the folder of the run, beside the
// scene or in a library path; where several do, all of them count, so that one that is added before
// another is a change too. Not found are names that the scene computes (concat("map", str(...)),
// a name out of a file that it reads), and what is named in a file of more than 64 MiB or with a
// zero byte. Names that are not ASCII do not count, because POV-Ray finds no such file; nor do
// POV-Ray's own folders (share/povray-3.7), for which its version stands.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mpipov {

// The string literals of a scene's text that may name files that it reads, in order. Comments are
// skipped, and what #fopen is to write.
std::vector<std::string> names_in_scene(std::string_view text);

// The files that one argument of POV-Ray's, or one line of an INI file, has it read: an INI file,
// a scene or a header (+HI). Names of what it writes are none of them.
std::vector<std::string> names_in_option(std::string_view option);

bool is_ini(const std::filesystem::path& file);

// What an argument of POV-Ray's, or a line of an INI file, may be: one option that has blanks, or
// several; so all of it, and each of its words.
std::vector<std::string_view> readings_of(std::string_view option);

struct SceneRequest {
    std::string scene;                 // as POV-Ray was given it
    std::vector<std::string> options;  // POV-Ray's command line
    std::vector<std::filesystem::path> library_paths;
    std::filesystem::path output;  // does not count: an image of that name comes and goes
};

// Sorted, each once, relative to the current folder where they were named so. What is missing or
// cannot be read is left out; throws nothing but std::bad_alloc.
std::vector<std::filesystem::path> scene_files(const SceneRequest& request);

// The same by every name that leads to one of them, links not followed: where a copy must have it.
struct SceneNames {
    std::vector<std::filesystem::path> all;
    // Of those the absolute ones that stand so in the text of a scene or of what it includes.
    std::vector<std::filesystem::path> absolute_in_text;
};
SceneNames scene_names(const SceneRequest& request);

// The files that POV-Ray may take for a name: itself, and where it has no extension, with each of
// those that POV-Ray appends for any kind of file.
std::vector<std::filesystem::path> files_tried_for(const std::filesystem::path& name);

// .../share/povray-3.7/...: POV-Ray's own folders, for which its version stands. A user's folder
// may be called povray-3.7 too.
bool is_povrays_own(const std::filesystem::path& file);

}  // namespace mpipov
