// What POV-Ray 3.7 prints, as numbers. Pure text in, values out; the shapes of the texts were
// recorded from Debian's 3.7.0.10 (testdata/). Times are seconds.
#pragma once

#include "section.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mpipov {

// POV-Ray breaks its console lines at 80 columns, within words where it must, and keeps every
// character: taking the line feed out again restores the text.
std::vector<std::string> unwrap_lines(std::string_view text);

// The block "Image Output Options", printed before the scene is parsed: POV-Ray's own answer to
// what the command line, the INI files and the defaults ask for.
struct ImageOptions {
    std::string input_file;  // as POV-Ray was given it
    int width = 0, height = 0;
    Rect region;              // half-open, 0-based; empty or outside where POV-Ray would refuse it
    std::string output_file;  // with directory and extension; empty where there is none
    std::string type;         // PNG, EXR, HDR, JPEG, Targa, BMP, PPM, ... as printed
    int bits_per_pixel = 0;   // as printed; 0: grayscale
    bool alpha = false, rle = false;
    bool to_standard_output = false;
    int jpeg_quality = 0;
    std::string dithering = "Off";
    bool animation = false;
    int frames = 1;  // how many of an animation this run renders (+SF, +EF), not how many it has
};
std::optional<ImageOptions> parse_image_options(std::string_view text);

struct Antialiasing {
    bool on = false;
    int method = 1, depth = 3;
    double threshold = 0;
};

// What a launch printed about itself.
struct LaunchReport {
    bool finished = false;  // "POV-Ray finished" was printed
    double parse_seconds = 0, photon_seconds = 0, radiosity_seconds = 0, trace_seconds = 0;
    double parse_cpu = 0, photon_cpu = 0, radiosity_cpu = 0, trace_cpu = 0;
    bool photons = false, radiosity = false;
    Antialiasing antialiasing;
    std::map<std::string, long long> counters;  // "Media Samples", "Isosurface roots", ...
};
LaunchReport parse_report(std::string_view text);

// True once a launch has printed all of its statistics, the last thing that it prints of its work.
bool statistics_are_printed(std::string_view text);

// The last "Rendered N of M pixels" as a fraction, where there is one.
std::optional<double> parse_progress(std::string_view text);

// POV-Ray's warnings, unwrapped, in order, each once.
std::vector<std::string> parse_warnings(std::string_view text);

// The line that says best why POV-Ray failed; never empty. (Which option it refuses it never says.)
std::string parse_error(std::string_view text);

// True where POV-Ray refused an option (and not the scene).
bool is_option_error(std::string_view text);

// "3.7.0.10.unofficial" out of `povray --version` or a render's first lines.
std::optional<std::string> parse_version(std::string_view text);

// Keys and values of an INI file in its order, values without their quotation marks. POV-Ray writes
// one with +GI: the settings as it resolved them (not quite all: File_Gamma is missing).
using IniSettings = std::vector<std::pair<std::string, std::string>>;
IniSettings ini_settings(std::string_view text);

// The same as a map.
// Keys are lower case; of repeated ones (Library_Path) the last stays.
std::map<std::string, std::string> parse_ini(std::string_view text);

// How many radiosity samples a launch says that it took; 0 where it says nothing of it.
long long radiosity_samples(std::string_view text);

}  // namespace mpipov
