#include "report_input.h"

#include "failure.h"
#include "interrupt.h"
#include "json_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Type = json::value_t;

constexpr int version = 1;

struct Part {
    std::string_view name;
    Type type;
};

constexpr std::array<std::string_view, 5> kinds{"seams", "speedup", "noise", "tradeoff",
                                                "stability"};
constexpr std::array<Part, 5> seams_parts{{{"scene", Type::string},
                                           {"complete", Type::boolean},
                                           {"image", Type::object},
                                           {"effects", Type::object},
                                           {"cases", Type::array}}};
constexpr std::array<Part, 2> case_parts{{{"name", Type::string}, {"verdict", Type::object}}};
constexpr std::array<Part, 1> compared_parts{{{"comparison", Type::object}}};
constexpr std::array<Part, 2> comparison_parts{
    {{"identical", Type::boolean}, {"differing", Type::number_unsigned}}};
constexpr std::array<Part, 1> rows_parts{{{"rows", Type::array}}};
constexpr std::array<Part, 2> stability_parts{
    {{"moves", Type::array}, {"complete", Type::boolean}}};
constexpr std::array<Part, 1> noise_parts{{{"noise", Type::object}}};

json parse(const fs::path& file) {
    std::ifstream in(file);
    if (!in) throw std::system_error(errno, std::generic_category(), "cannot be read");
    return parse_json(in);
}

template <std::size_t N>
void check_parts(const json& object, const std::array<Part, N>& parts, const std::string& of,
                 std::vector<std::string>& problems) {
    for (const Part& part : parts) {
        const auto found = object.find(part.name);
        if (found == object.end())
            problems.push_back(fmt::format("{}lacks '{}'", of, part.name));
        else if (found->type() != part.type)
            problems.push_back(fmt::format("{}has a '{}' that is {}, not {}", of, part.name,
                                           found->type_name(), json(part.type).type_name()));
    }
}

void check_case(const json& one, const std::string& of, std::vector<std::string>& problems) {
    check_parts(one, case_parts, of, problems);
    if (one.value("failure", json()).is_string()) return;  // there was nothing to compare
    check_parts(one, compared_parts, of, problems);
    const auto comparison = one.find("comparison");
    if (comparison != one.end() && comparison->is_object())
        check_parts(*comparison, comparison_parts, of + "has a comparison that ", problems);
}

void check_cases(const json& data, std::vector<std::string>& problems) {
    const auto cases = data.find("cases");
    if (cases == data.end() || !cases->is_array()) return;
    for (std::size_t i = 0; i < cases->size(); ++i) {
        const json& one = (*cases)[i];
        const std::string of = fmt::format("case {} ", i + 1);
        if (!one.is_object())
            problems.push_back(fmt::format("{}is {}, not an object", of, one.type_name()));
        else
            check_case(one, of, problems);
    }
}

void check(const json& data, std::string_view kind, std::vector<std::string>& problems) {
    if (const json found = data.value("version", json()); found != version && !found.is_null())
        problems.push_back(
            fmt::format("its version is {}, this program reads {}", found.dump(), version));
    if (kind == "seams") {
        // Where the whole failed, what was to come after is rightly not there.
        if (data.value("failure", json()).is_string())
            check_parts(data, std::array<Part, 1>{seams_parts[0]}, "", problems);
        else
            check_parts(data, seams_parts, "", problems);
        check_cases(data, problems);
    } else if (kind == "speedup" || kind == "tradeoff") {
        check_parts(data, rows_parts, "", problems);
    } else if (kind == "stability") {
        check_parts(data, stability_parts, "", problems);
    } else {
        check_parts(data, noise_parts, "", problems);
    }
}

json read_entry(const fs::path& file, const fs::path& root, std::string_view kind) {
    std::vector<std::string> problems;
    json data;
    try {
        data = parse(file);
        if (!data.is_object()) {
            problems.push_back(fmt::format("holds {}, not an object", data.type_name()));
            data = nullptr;
        } else {
            const json format = data.value("format", json());
            const std::string expected = fmt::format("mpipov-{}", kind);
            if (format != expected && !format.is_null()) {
                problems.push_back(
                    fmt::format("its format is {}, not \"{}\"", format.dump(), expected));
                data = nullptr;
            } else {
                // Only the format of seams.json is fixed: the others may go without.
                if (format.is_null() && kind == "seams") problems.emplace_back("lacks 'format'");
                check(data, kind, problems);
            }
        }
    } catch (const std::exception& error) {
        problems.emplace_back(plain_words(error.what()));
        data = nullptr;
    }
    return {{"kind", kind},
            {"file", file.lexically_relative(root).string()},
            {"folder", file.parent_path().string()},
            {"problems", problems},
            {"data", data}};
}

}  // namespace

json collect_results(const fs::path& root) {
    std::vector<fs::path> files;
    try {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(
                 root, fs::directory_options::skip_permission_denied)) {
            throw_if_interrupted();
            const std::string name = entry.path().filename().string();
            const bool ours = std::any_of(kinds.begin(), kinds.end(), [&](std::string_view kind) {
                return name == fmt::format("{}.json", kind);
            });
            if (ours && entry.is_regular_file()) files.push_back(entry.path());
        }
    } catch (const fs::filesystem_error& error) {
        throw Failure(Exit::file,
                      fmt::format("cannot search '{}': {}", root.string(), error.code().message()));
    }
    std::sort(files.begin(), files.end());
    json entries = json::array();
    for (const fs::path& file : files) {
        throw_if_interrupted();
        entries.push_back(read_entry(file, root, file.stem().string()));
    }
    return {{"format", "mpipov-report"},
            {"version", version},
            {"root", root.string()},
            {"entries", entries}};
}

}  // namespace mpipov
