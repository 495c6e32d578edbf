#include "povray_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace mpipov {
namespace {

bool has_blank(std::string_view text) {
    return text.find_first_of(" \t") != std::string_view::npos;
}

// True where a piece after a blank could be an option or an INI setting of its own.
bool could_be_several(std::string_view text) {
    for (std::size_t at = text.find_first_of(" \t"); at != std::string_view::npos;
         at = text.find_first_of(" \t", at + 1)) {
        const std::string_view rest = text.substr(at + 1);
        if (!rest.empty() && (rest[0] == '+' || rest[0] == '-')) return true;
        if (rest.substr(0, rest.find_first_of(" \t")).find('=') != std::string_view::npos)
            return true;
    }
    return false;
}

std::string quoted(std::string_view text) {
    const char mark = text.find('"') == std::string_view::npos ? '"' : '\'';
    return fmt::format("{0}{1}{0}", mark, text);
}

// The length of a leading file option (+I, -O, +HI, ...), 0 where there is none.
std::size_t file_option_length(std::string_view argument) {
    if (argument.empty() || (argument[0] != '+' && argument[0] != '-')) return 0;
    std::string lower(argument.substr(1, 2));
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const std::string_view name : {"hi", "rf", "gi"})
        if (lower == name) return 3;
    for (const char name : {'i', 'o', 'l'})
        if (!lower.empty() && lower[0] == name) return 2;
    return 0;
}

std::string quote_argument(const std::string& argument) {
    if (!has_blank(argument) || could_be_several(argument)) return argument;
    const std::size_t option = file_option_length(argument);
    if (option == 0 && (argument[0] == '+' || argument[0] == '-')) return argument;
    std::size_t value = option;
    if (option == 0) {
        const auto equals = argument.find('=');  // Output_File_Name=my picture.png
        value = equals == std::string::npos ? 0 : equals + 1;
    }
    const std::string_view name = std::string_view(argument).substr(value);
    if (name.empty() || name[0] == '"' || name[0] == '\'') return argument;
    return argument.substr(0, value) + quoted(name);
}

// All but what it writes.
std::vector<std::string> command(const JobCommand& job, const std::vector<std::string>& area) {
    std::vector<std::string> argv{job.povray};
    argv.insert(argv.end(), job.user_arguments.begin(), job.user_arguments.end());
    argv.insert(argv.end(), job.format_arguments.begin(), job.format_arguments.end());
    // No display, no pause, no continued trace, no INI file of the user's once per section; all
    // streams to the console, where we read them.
    for (const char* ours : {"-D", "-P", "-C", "+V", "Create_Ini=", "All_Console=on"})
        argv.emplace_back(ours);
    argv.insert(argv.end(), area.begin(), area.end());
    argv.push_back(fmt::format("+WT{}", job.threads));
    if (job.block > 0) argv.push_back(fmt::format("+BS{}", job.block));
    return argv;
}

std::vector<std::string> image_command(const JobCommand& job, const std::vector<std::string>& area,
                                       const std::filesystem::path& output_base) {
    std::vector<std::string> argv = command(job, area);
    // Not by many launches side by side.
    argv.emplace_back("-RFO");
    // What is loaded makes the pretrace vain.
    if (!job.radiosity_cache.empty())
        for (const std::string& one : {std::string("+RFI"), std::string("-RVP"),
                                       fmt::format("+RF\"{}\"", job.radiosity_cache.string())})
            argv.push_back(one);
    argv.push_back(fmt::format("+O\"{}\"", output_base.string()));
    return argv;
}

}  // namespace

Rect launch_area(const Rect& render, const ImageSize& image) {
    Rect area = render;
    if (area.x1 == 1 && image.width > 1) area.x1 = 2;
    if (area.y1 == 1 && image.height > 1) area.y1 = 2;
    return area;
}

std::vector<std::string> area_arguments(const Rect& area) {
    const auto start = [](int from) { return from == 0 ? 0 : from + 1; };
    return {fmt::format("+SC{}", start(area.x0)), fmt::format("+EC{}", area.x1),
            fmt::format("+SR{}", start(area.y0)), fmt::format("+ER{}", area.y1)};
}

std::vector<std::string> whole_command(const JobCommand& job,
                                       const std::filesystem::path& output_base) {
    return image_command(job, {}, output_base);
}

std::vector<std::string> section_command(const JobCommand& job, const Rect& render,
                                         const ImageSize& image,
                                         const std::filesystem::path& output_base) {
    return image_command(job, area_arguments(launch_area(render, image)), output_base);
}

std::vector<std::string> gather_command(const JobCommand& job, const Rect& render,
                                        const ImageSize& image, const std::filesystem::path& cache,
                                        bool reads) {
    std::vector<std::string> argv = command(job, area_arguments(launch_area(render, image)));
    // No image, and no antialiasing, whose rays between the pixels take hardly any new samples.
    for (const std::string& one :
         {fmt::format("+W{}", image.width), fmt::format("+H{}", image.height), std::string("-A"),
          std::string("-F"), std::string(reads ? "+RFI" : "-RFI"), std::string("+RFO"),
          fmt::format("+RF\"{}\"", cache.string())})
        argv.push_back(one);
    if (reads) argv.emplace_back("-RVP");
    return argv;
}

std::vector<std::pair<std::string, std::string>> temporary_files_in(
    const std::filesystem::path& folder) {
    return {{"POV_TEMP_DIR", folder.string()}};
}

std::vector<std::pair<std::string, std::string>> launch_environment(
    const JobCommand& job, const std::filesystem::path& folder) {
    auto environment = temporary_files_in(folder);
    if (!job.ini.empty()) environment.emplace_back("POVINI", job.ini.string());
    return environment;
}

std::vector<std::string> quote_arguments(const std::vector<std::string>& arguments) {
    std::vector<std::string> out;
    out.reserve(arguments.size());
    for (const std::string& argument : arguments) out.push_back(quote_argument(argument));
    return out;
}

std::vector<std::string> section_format(const std::string& type) {
    if (type == "JPEG") return {"+FP8"};
    if (type == "Targa") return {"+FN8"};
    return {};
}

}  // namespace mpipov
