// From a section to POV-Ray's argv. Pure.
//
// The user's arguments are passed on as they are, ours come after them: of repeated options POV-Ray
// takes the last. +SC/+EC/+SR/+ER are 1-based and inclusive, and a value <= 1.0 is a fraction
// (+EC1 means 100 %), so a start at pixel 0 is written +SC0, and nothing may end at column or row
// 1: launch_area() makes such a section one pixel larger, and the reader crops it.
#pragma once

#include "section.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mpipov {

struct ImageSize {
    int width = 0, height = 0;  // of the whole image, pixels
};

// The rectangle that POV-Ray is really told to render so that `render` is in it.
Rect launch_area(const Rect& render, const ImageSize& image);

// +SC/+EC/+SR/+ER for it.
std::vector<std::string> area_arguments(const Rect& launch_area);

// What is the same for every section of a job.
struct JobCommand {
    std::string povray = "povray";
    std::vector<std::string> user_arguments;    // quoted as POV-Ray wants them
    std::vector<std::string> format_arguments;  // how sections are stored, empty: as the user said
    int threads = 1;
    int block = 0;  // +BS, 0: as the user said
    // A radiosity cache that every launch reads; empty: none of ours.
    std::filesystem::path radiosity_cache = {};
};

// The whole argv. `output_base` is the section's own: POV-Ray names the image and its .pov-state
// after it, and must not contain a quotation mark.
std::vector<std::string> section_command(const JobCommand& job, const Rect& render,
                                         const ImageSize& image,
                                         const std::filesystem::path& output_base);

// The argv of a launch that writes no image but takes radiosity samples, into `cache`: behind those
// that are there already where it `reads` them first.
std::vector<std::string> gather_command(const JobCommand& job, const Rect& render,
                                        const ImageSize& image, const std::filesystem::path& cache,
                                        bool reads);

// section_command for all that the user asked for: no area, so it can start before anybody knows
// the size.
std::vector<std::string> whole_command(const JobCommand& job,
                                       const std::filesystem::path& output_base);

// What a launch's environment is given besides ours. POV-Ray keeps a large image in a temporary
// file, which stays behind where it is killed; it asks POV_TEMP_DIR for the place, not TMPDIR.
std::vector<std::pair<std::string, std::string>> temporary_files_in(
    const std::filesystem::path& folder);

// POV-Ray splits an argument at blanks (`"+W320 +H240"` are two options), so a file name that has
// blanks must be in quotation marks. Users do not expect that: where an argument is a file option
// with blanks that can only be part of the name, this adds the marks.
std::vector<std::string> quote_arguments(const std::vector<std::string>& arguments);

// The section format for a final type, as POV-Ray prints it ("PNG"): lossless, and readable row by
// row. JPEG is stored as 8-bit PPM (neither knows alpha), TGA as 8-bit PNG (OpenImageIO reads TGA
// only as a whole); everything else as it is.
std::vector<std::string> section_format(const std::string& type);

}  // namespace mpipov
