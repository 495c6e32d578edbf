// POV-Ray's arguments as we pass them on, and the files that they and scenes name. The first line
// is an argument, all of it a scene.
#include "entry.h"
#include "povray_command.h"
#include "scene_files.h"

#include <algorithm>
#include <string>

namespace {

using namespace mpipov;
using fuzz::require;

void check_quotes(const std::string& argument) {
    const std::string once = quote_arguments({argument}).front();
    require(quote_arguments({once}).front() == once, "quoting twice is quoting once");
    if (once == argument) return;
    // One pair of marks, around the rest of it.
    require(once.size() == argument.size() + 2, "two marks are added");
    const char mark = once.back();
    require(mark == '"' || mark == '\'', "a mark is a quotation mark");
    // What stands before the opening one may hold the same mark.
    bool same = false;
    for (std::size_t open = once.find(mark); open + 1 < once.size() && !same;
         open = once.find(mark, open + 1))
        same = once.substr(0, open) + once.substr(open + 1, once.size() - open - 2) == argument;
    require(same, "without its marks it is what it was");
}

void check_names(const std::vector<std::string>& names, std::string_view text) {
    std::size_t all = 0;
    for (const std::string& name : names) {
        require(!name.empty(), "no name is empty");
        all += name.size();
    }
    // Each is some piece of the text; an option's may be found with and without its blanks.
    require(all <= 2 * text.size(), "names are pieces of the text");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::as_text(data, size);
    const std::string argument(text.substr(0, text.find('\n')));
    if (!argument.empty()) check_quotes(argument);
    check_names(names_in_option(argument), argument);
    const std::vector<std::string> names = names_in_scene(text);
    check_names(names, text);
    for (const std::string& name : names)
        require(name.find('\n') == std::string::npos, "a name ends within its line");

    // The name of a file that is one argument is found in it.
    const bool plain =
        !argument.empty() && argument.find_first_of("+-=\"'[]; \t\v\f\r\n") == std::string::npos;
    if (plain) {
        require(names_in_option("+I" + argument) == std::vector{argument}, "+I names a file");
        require(names_in_scene("#include \"" + argument + "\"") == std::vector{argument} ||
                    argument.find('\\') != std::string::npos,
                "an include names a file");
    }
    return 0;
}
