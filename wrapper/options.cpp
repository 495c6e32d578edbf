#include "options.h"

#include "failure.h"
#include "option_values.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <functional>

namespace mpipov {
namespace {

constexpr const char* usage_line =
    "[mpiexec -n RANKS] mpipov [--option ...] SCENE.pov|SCENE.ini [POV-Ray's own options]";
constexpr const char* summary =
    "Renders a POV-Ray scene in sections, side by side on many cores or hosts, with the POV-Ray "
    "that is installed, and puts the sections together to the image that one POV-Ray would have "
    "written. Every argument that begins with -- is mpipov's own; all others are POV-Ray's.";

struct Row {
    const char* group;
    const char* name;   // without --
    const char* value;  // how the value is called; nullptr: a flag
    const char* text;
    const char* preset;
    void (*apply)(Options&, const std::string& value);
    bool repeats = false;  // may be given several times
};

constexpr const char* cutting = "Cutting the image up";
constexpr const char* sharing = "Sharing the work";
constexpr const char* files = "Files";
constexpr const char* keeping = "What a scene may do";
constexpr const char* faults = "When something goes wrong";
constexpr const char* saying = "What is said";

constexpr std::array rows{
    Row{cutting, "sections", "G", "into how many sections", "auto",
        [](Options& o, const std::string& v) {
            o.sections = whole_or_auto(v, "a number of sections: auto or a whole number from 1");
        }},
    Row{cutting, "shape", "SHAPE",
        "columns, rows or tiles; auto: columns while the image has enough of them, then tiles",
        "auto", set_shape},
    Row{cutting, "seams", "KIND",
        "aligned: edges on POV-Ray's 32-pixel block grid, bit for bit the default serial render; "
        "halo[:N]: edges anywhere and N (2) pixels of overlap, as a serial render in one block; "
        "plain: edges anywhere; auto: aligned with antialiasing of method 1, else plain",
        "auto", set_seams},
    Row{cutting, "radiosity", "HOW",
        "how sections come by radiosity samples; independent: each takes its own; shared[:PASSES]: "
        "one launch renders everything first, PASSES times, and all read its samples; "
        "joined[:PASSES]: sections gather samples side by side, coarse passes first, in the last "
        "one neighbours one after the other; auto: joined where the scene has radiosity",
        "auto", set_radiosity},
    Row{cutting, "radiosity-scale", "N",
        "samples are gathered at 1/N of the image's width and height; auto: 1 with shared, with "
        "joined so that the longer side has 400 to 800 pixels",
        "auto",
        [](Options& o, const std::string& v) {
            o.radiosity_scale = whole_or_auto(v, "a scale: auto or a whole number from 1");
        }},
    Row{sharing, "schedule", "HOW",
        "static: each rank has its sections from the start; dynamic: the next section goes to "
        "whoever is free; cost: the same by what the parts of the picture cost, the longest first",
        "dynamic", set_schedule},
    Row{sharing, "slots", "N",
        "cores that this rank keeps its launches to; auto: its share of its host", "auto",
        [](Options& o, const std::string& v) {
            o.slots = whole_or_auto(v, "a number of cores: auto or a whole number from 1");
        }},
    Row{sharing, "threads", "N", "POV-Ray's threads in one launch", "auto",
        [](Options& o, const std::string& v) {
            o.threads = whole_or_auto(v, "a number of threads: auto or a whole number from 1");
        }},
    Row{sharing, "in-flight", "K", "launches under way per rank, to hide that each starts idle",
        "auto",
        [](Options& o, const std::string& v) {
            o.in_flight = whole_or_auto(v, "a number of launches: auto or a whole number from 1");
        }},
    Row{sharing, "dedicated-coordinator", nullptr, "rank 0 renders nothing, as in MPIPOV2", nullptr,
        [](Options& o, const std::string&) { o.dedicated_coordinator = true; }},
    Row{files, "ship", "WHEN",
        "whether a packed copy of the scene, with the files that it names, is sent to other hosts: "
        "on, off, or auto: where a host lacks one of the files or has another one of that name",
        "auto", set_ship},
    Row{files, "record", "FILE", "where the record of the run goes", "run.json beside the image",
        [](Options& o, const std::string& v) { o.record = v; }},
    Row{files, "work-dir", "DIR", "where finished sections are kept until the image is complete",
        "beside the image", [](Options& o, const std::string& v) { o.work_dir = v; }},
    Row{files, "povray", "PATH", "which POV-Ray to run", "povray",
        [](Options& o, const std::string& v) { o.povray = v; }},
    Row{keeping, "allow-read", "DIR",
        "a folder (or file) that the scene may read, besides its own folder, the one of the run, "
        "those of +L and POV-Ray's own; may be given several times; / allows all",
        nullptr, [](Options& o, const std::string& v) { o.allow_read.emplace_back(v); }, true},
    Row{keeping, "allow-write", "DIR",
        "a folder that the scene may read and write (#fopen), besides one that is removed after "
        "each launch; may be given several times",
        nullptr, [](Options& o, const std::string& v) { o.allow_write.emplace_back(v); }, true},
    Row{keeping, "confine", "HOW",
        "auto: keep POV-Ray to those folders where the kernel can (Landlock); on: or do not start; "
        "off: do not",
        "auto", set_confine},
    Row{keeping, "memory-limit", "SIZE",
        "memory that a launch may take: 512M, 2G, none; auto: its threads' share of the host's",
        "auto", [](Options& o, const std::string& v) { o.memory_limit = size_limit(v); }},
    Row{keeping, "disk-limit", "SIZE",
        "what a launch may write: 512M, 2G, none; auto: 1G and what the image takes, but no more "
        "than half of what is free",
        "auto", [](Options& o, const std::string& v) { o.disk_limit = size_limit(v); }},
    Row{faults, "resume", nullptr,
        "go on from what an interrupted run left in its work folder, unless the scene, a file that "
        "it names or a setting changed",
        nullptr, [](Options& o, const std::string&) { o.resume = true; }},
    Row{faults, "timeout", "S", "seconds after which a launch of POV-Ray counts as hung", "auto",
        set_timeout},
    Row{faults, "retries", "N", "how often a section that failed is tried again", "2",
        [](Options& o, const std::string& v) {
            o.retries = whole(v, 0, "a number of retries: a whole number from 0");
        }},
    Row{faults, "lost-after", "S",
        "with several hosts: seconds after which a rank that says nothing counts as lost, and the "
        "run "
        "ends",
        "15", set_lost_after},
    Row{saying, "dry-run", nullptr, "print the plan and its predicted cost as JSON, and stop",
        nullptr, [](Options& o, const std::string&) { o.dry_run = true; }},
    Row{saying, "progress", "STYLE",
        "auto: a live line on a terminal, plain lines elsewhere (mpiexec hands a pipe on); plain; "
        "none: warnings only",
        "auto", set_progress},
    Row{saying, "help", nullptr, "this text", nullptr,
        [](Options& o, const std::string&) { o.help = true; }},
    Row{saying, "version", nullptr, "the versions of mpipov, POV-Ray, MPI and OpenImageIO", nullptr,
        [](Options& o, const std::string&) { o.version = true; }},
    Row{saying, "manual", nullptr, "the manual page, as troff source", nullptr,
        [](Options& o, const std::string&) { o.manual = true; }},
};

const Row* find_row(const std::string& name) {
    for (const Row& row : rows)
        if (name == row.name) return &row;
    return nullptr;
}

// POV-Ray's arguments are taken out first: to CLI11 they would be short options.
std::vector<std::string> take_ours(const std::vector<std::string>& arguments,
                                   std::vector<std::string>& povray_arguments) {
    std::vector<std::string> ours;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        if (argument == "--") {
            povray_arguments.insert(povray_arguments.end(), arguments.begin() + i + 1,
                                    arguments.end());
            break;
        }
        if (argument.rfind("--", 0) != 0) {
            povray_arguments.push_back(argument);
            continue;
        }
        ours.push_back(argument);
        const auto equals = argument.find('=');
        const Row* row = find_row(argument.substr(2, equals - 2));
        if (equals != std::string::npos) {
            if (row != nullptr && row->value == nullptr)
                throw Failure(Exit::usage, fmt::format("--{} takes no value", row->name));
            continue;
        }
        if (row == nullptr || row->value == nullptr) continue;
        if (i + 1 == arguments.size() || arguments[i + 1].rfind("--", 0) == 0)
            throw Failure(Exit::usage, fmt::format("--{} needs a value: --{} {}", row->name,
                                                   row->name, row->value));
        ours.push_back(arguments[++i]);
    }
    return ours;
}

// `apply` is called with the value, "" of a flag.
void add_row(CLI::App& app, const Row& row, const std::function<void(const std::string&)>& apply) {
    const std::string flag = fmt::format("--{}", row.name);
    const auto checked = [flag, apply](const std::string& value) {
        try {
            apply(value);
        } catch (const Failure& failure) {
            throw CLI::ValidationError(flag, failure.what());
        }
    };
    CLI::Option* option = row.value == nullptr
                              ? app.add_flag_function(
                                    flag, [checked](std::int64_t) { checked(""); }, row.text)
                              : app.add_option_function<std::string>(flag, checked, row.text);
    option->group(row.group);
    if (row.value != nullptr) option->type_name(row.value)->trigger_on_parse(row.repeats);
    if (row.preset != nullptr) option->default_str(row.preset);
}

void add_rows(CLI::App& app, Options& options) {
    for (const Row& row : rows)
        add_row(app, row,
                [&row, &options](const std::string& value) { row.apply(options, value); });
}

std::string troff(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '-') out += '\\';
        out += c;
    }
    return out;
}

}  // namespace

Options parse_options(const std::vector<std::string>& arguments) {
    Options options;
    std::vector<std::string> ours = take_ours(arguments, options.povray_arguments);
    CLI::App app;
    app.set_help_flag();
    add_rows(app, options);
    std::reverse(ours.begin(), ours.end());  // as CLI11 wants a vector
    try {
        app.parse(ours);
    } catch (const CLI::ExtrasError&) {
        for (const std::string& argument : ours)
            if (argument.rfind("--", 0) == 0 &&
                find_row(argument.substr(2, argument.find('=') - 2)) == nullptr)
                throw Failure(Exit::usage,
                              fmt::format("unknown option '{}': see mpipov --help", argument));
        throw Failure(Exit::usage, "an option got a value too many: see mpipov --help");
    } catch (const CLI::ParseError& error) {
        throw Failure(Exit::usage, error.what());
    }
    require_passable(options.povray_arguments);
    return options;
}

void add_keeping_options(CLI::App& app, Options& options, std::vector<std::string>& given) {
    for (const Row& row : rows) {
        if (std::string_view(row.group) != keeping) continue;
        add_row(app, row, [&row, &options, &given](const std::string& value) {
            row.apply(options, value);
            given.push_back(fmt::format("--{}={}", row.name, value));
        });
    }
}

std::string help_text() {
    Options options;
    CLI::App app;
    app.set_help_flag();
    add_rows(app, options);
    const auto formatter = std::make_shared<CLI::Formatter>();
    formatter->column_width(32);
    app.formatter(formatter);
    return fmt::format("{}\n\nUsage: {}\n{}", summary, usage_line,
                       formatter->make_groups(&app, CLI::AppFormatMode::Normal));
}

std::string manual_page() {
    std::string page = fmt::format(
        ".TH MPIPOV 1 \"\" \"mpipov {}\"\n.SH NAME\nmpipov \\- render a POV\\-Ray scene in "
        "sections "
        "over MPI\n.SH SYNOPSIS\n{}\n.SH DESCRIPTION\n{}\n",
        MPIPOV_VERSION, troff(usage_line), troff(summary));
    const char* group = "";
    for (const Row& row : rows) {
        if (std::string_view(group) != row.group) {
            group = row.group;
            page += fmt::format(".SH {}\n", troff(group));
        }
        page += fmt::format(".TP\n\\fB\\-\\-{}\\fR", troff(row.name));
        if (row.value != nullptr) page += fmt::format(" \\fI{}\\fR", row.value);
        page += fmt::format("\n{}", troff(row.text));
        if (row.preset != nullptr) page += fmt::format(" (default: {})", troff(row.preset));
        page += '\n';
    }
    page +=
        ".SH EXIT STATUS\n0 ok, 2 usage, 3 the scene or POV\\-Ray, 4 a file, the disk "
        "or too little memory for the image, "
        "5 interrupted or a rank was lost (\\fB\\-\\-resume\\fR goes on).\n";
    return page;
}

}  // namespace mpipov
