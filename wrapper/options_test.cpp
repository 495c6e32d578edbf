#include "options.h"

#include "failure.h"
#include "scratch.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <set>

namespace mpipov {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

struct Case {
    const char* name;
    const char* value;  // nullptr: a flag
    std::function<bool(const Options&)> holds;
};

// Every option once, with a value that is not its default.
std::vector<Case> cases() {
    return {
        {"sections", "7", [](const Options& o) { return o.sections == 7; }},
        {"shape", "rows", [](const Options& o) { return o.shape == Shape::rows; }},
        {"seams", "plain", [](const Options& o) { return o.seams == Seams::plain; }},
        {"radiosity", "shared:3",
         [](const Options& o) {
             return o.radiosity == Sharing::shared && o.radiosity_passes == 3;
         }},
        {"radiosity-scale", "2", [](const Options& o) { return o.radiosity_scale == 2; }},
        {"schedule", "static", [](const Options& o) { return o.schedule == Policy::static_; }},
        {"slots", "3", [](const Options& o) { return o.slots == 3; }},
        {"threads", "4", [](const Options& o) { return o.threads == 4; }},
        {"in-flight", "5", [](const Options& o) { return o.in_flight == 5; }},
        {"dedicated-coordinator", nullptr,
         [](const Options& o) { return o.dedicated_coordinator; }},
        {"record", "r.json", [](const Options& o) { return o.record == "r.json"; }},
        {"ship", "off", [](const Options& o) { return o.ship == Ship::off; }},
        {"work-dir", "w", [](const Options& o) { return o.work_dir == "w"; }},
        {"povray", "/opt/povray", [](const Options& o) { return o.povray == "/opt/povray"; }},
        {"allow-read", "a b",
         [](const Options& o) {
             return o.allow_read == std::vector<std::filesystem::path>{"a b"};
         }},
        {"allow-write", "w",
         [](const Options& o) { return o.allow_write == std::vector<std::filesystem::path>{"w"}; }},
        {"confine", "on", [](const Options& o) { return o.confine == Confining::on; }},
        {"memory-limit", "512M",
         [](const Options& o) { return o.memory_limit.bytes == 512U << 20U; }},
        {"disk-limit", "none",
         [](const Options& o) { return !o.disk_limit.automatic && !o.disk_limit.bytes; }},
        {"resume", nullptr, [](const Options& o) { return o.resume; }},
        {"timeout", "2.5", [](const Options& o) { return o.timeout_seconds == 2.5; }},
        {"retries", "0", [](const Options& o) { return o.retries == 0; }},
        {"lost-after", "40.5", [](const Options& o) { return o.lost_after_seconds == 40.5; }},
        {"dry-run", nullptr, [](const Options& o) { return o.dry_run; }},
        {"progress", "none", [](const Options& o) { return o.progress == ProgressStyle::none; }},
        {"help", nullptr, [](const Options& o) { return o.help; }},
        {"version", nullptr, [](const Options& o) { return o.version; }},
        {"manual", nullptr, [](const Options& o) { return o.manual; }},
    };
}

std::string usage_error(const std::vector<std::string>& arguments) {
    try {
        parse_options(arguments);
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::usage);
        return failure.what();
    }
    ADD_FAILURE() << "accepted: " << testing::PrintToString(arguments);
    return {};
}

// The options that a text shows, as --name.
std::set<std::string> options_in(const std::string& text) {
    std::set<std::string> names;
    static const std::regex shape(R"((?:^|[\s,])--([a-z][a-z-]*))");
    for (std::sregex_iterator it(text.begin(), text.end(), shape), end; it != end; ++it)
        names.insert((*it)[1]);
    return names;
}

std::set<std::string> all_options() {
    std::set<std::string> names;
    for (const Case& c : cases()) names.insert(c.name);
    return names;
}

TEST(Options, BothWaysToGiveAValue) {
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name);
        const std::string option = std::string("--") + c.name;
        EXPECT_FALSE(c.holds(parse_options({"scene.pov"})));
        if (c.value == nullptr) {
            const Options options = parse_options({option, "scene.pov"});
            EXPECT_TRUE(c.holds(options));
            EXPECT_THAT(options.povray_arguments, ElementsAre("scene.pov"));
            continue;
        }
        for (const auto& arguments :
             {std::vector<std::string>{option, c.value, "scene.pov"},
              std::vector<std::string>{"scene.pov", option, c.value},
              std::vector<std::string>{option + "=" + c.value, "scene.pov"}}) {
            const Options options = parse_options(arguments);
            EXPECT_TRUE(c.holds(options));
            EXPECT_THAT(options.povray_arguments, ElementsAre("scene.pov"));
        }
    }
}

TEST(Options, AutoIsTheDefault) {
    const Options options = parse_options({"--sections", "auto", "--shape=auto", "--seams", "auto",
                                           "--slots=auto", "--threads", "auto", "--in-flight=auto",
                                           "--timeout", "auto", "--progress", "auto"});
    EXPECT_FALSE(options.sections || options.shape || options.seams || options.slots ||
                 options.threads || options.in_flight || options.timeout_seconds);
    EXPECT_EQ(options.progress, ProgressStyle::automatic);
    EXPECT_EQ(options.schedule, Policy::dynamic);
    EXPECT_EQ(options.retries, 2);
    EXPECT_EQ(options.povray, "povray");
}

TEST(Options, EveryWordOfAChoice) {
    EXPECT_EQ(parse_options({"--shape=columns"}).shape, Shape::columns);
    EXPECT_EQ(parse_options({"--shape=tiles"}).shape, Shape::tiles);
    EXPECT_EQ(parse_options({"--seams=aligned"}).seams, Seams::aligned);
    EXPECT_EQ(parse_options({"--schedule=dynamic"}).schedule, Policy::dynamic);
    EXPECT_EQ(parse_options({"--schedule=cost"}).schedule, Policy::cost);
    EXPECT_EQ(parse_options({"--progress=plain"}).progress, ProgressStyle::plain);
    const Options halo = parse_options({"--seams=halo"});
    EXPECT_EQ(halo.seams, Seams::halo);
    EXPECT_EQ(halo.halo, 2);
    EXPECT_EQ(parse_options({"--seams", "halo:5"}).halo, 5);
}

TEST(Options, PovraysOwnAreUntouchedAndInOrder) {
    const std::vector<std::string> theirs{"scene.ini[section]",
                                          "+W640",
                                          "-D",
                                          "+A0.3",
                                          "-h",
                                          "-",
                                          "-sx",
                                          "Width=3",
                                          "+O-",
                                          "-i",
                                          "a b.pov"};
    std::vector<std::string> arguments = theirs;
    arguments.insert(arguments.begin() + 3, {"--sections", "4"});
    arguments.insert(arguments.begin() + 8, "--dry-run");
    arguments.emplace_back("--threads=2");
    const Options options = parse_options(arguments);
    EXPECT_EQ(options.povray_arguments, theirs);
    EXPECT_EQ(options.sections, 4);
    EXPECT_TRUE(options.dry_run);
    EXPECT_EQ(options.threads, 2);
}

TEST(Options, ALoneDoubleDashEndsOurs) {
    const Options options =
        parse_options({"--retries", "1", "a.pov", "--", "--resume", "--", "-D"});
    EXPECT_EQ(options.retries, 1);
    EXPECT_FALSE(options.resume);
    EXPECT_THAT(options.povray_arguments, ElementsAre("a.pov", "--resume", "--", "-D"));
    EXPECT_THAT(parse_options({"--"}).povray_arguments, IsEmpty());
}

TEST(Options, AnUnknownOneIsNamed) {
    for (const char* name :
         {"--no-such", "--no-such=3", "--Sections", "--section", "--threadss=2"}) {
        EXPECT_THAT(usage_error({"scene.pov", name, "--dry-run"}),
                    AllOf(HasSubstr("unknown"), HasSubstr(name), HasSubstr("--help")));
    }
}

TEST(Options, ABadValueNamesItsOption) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> bad{
        {"sections", {"0", "-1", "many", "1.5", "3x", "", "99999999999"}},
        {"slots", {"0", "-1", "x"}},
        {"threads", {"0", "1e3"}},
        {"in-flight", {"0", "two"}},
        {"retries", {"-1", "auto", "1.0"}},
        {"timeout", {"0", "-1", "nan", "inf", "1e999", "soon", "3s"}},
        {"shape", {"squares", "", "Columns"}},
        {"seams", {"halo:", "halo:0", "halo:-1", "halo:x", "haloes", "aligned:2"}},
        {"schedule", {"costs", "auto", ""}},
        {"progress", {"loud", ""}},
    };
    for (const auto& [name, values] : bad)
        for (const std::string& value : values) {
            const std::string argument = fmt::format("--{}={}", name, value);
            SCOPED_TRACE(argument);
            EXPECT_THAT(usage_error({"scene.pov", argument}),
                        HasSubstr(argument.substr(0, argument.find('='))));
        }
}

TEST(Options, FoldersMayBeAllowedSeveralTimes) {
    const Options options = parse_options({"--allow-read", "a", "scene.pov", "--allow-read=b"});
    EXPECT_THAT(options.allow_read, ElementsAre("a", "b"));
    EXPECT_THAT(options.povray_arguments, ElementsAre("scene.pov"));
}

TEST(Options, SizesHaveUnits) {
    const auto bytes = [](const std::string& value) {
        return parse_options({"--disk-limit", value}).disk_limit.bytes.value_or(0);
    };
    EXPECT_EQ(bytes("1000"), 1000U);
    EXPECT_EQ(bytes("1.5k"), 1536U);
    EXPECT_EQ(bytes("2G"), std::uint64_t{2} << 30);
    EXPECT_TRUE(parse_options({"--disk-limit", "auto"}).disk_limit.automatic);
    for (const char* bad : {"", "G", "1X", "1GB", "-1", "0", "nan", "inf", "1e30", "9999999T"})
        EXPECT_THAT(
            [&] {
                parse_options({"--disk-limit", bad});
            },
            ThrowsMessage<Failure>(HasSubstr("disk-limit")))
            << bad;
}

TEST(Options, NamesOfFilesArePassedOnLiterallyOrRefused) {
    const std::vector<std::string> odd{"sch\xc3\xb6n.pov", "sch\xf6n.pov", "a\tb.pov", "./--x.pov",
                                       "+O\"my picture.png\""};
    EXPECT_EQ(parse_options(odd).povray_arguments, odd);
    EXPECT_THAT(parse_options({"--", "--x.pov"}).povray_arguments, ElementsAre("--x.pov"));
    for (const char* bad : {"two\nlines.pov", "a\rb.pov", "bell\a.pov", "a\x7f.pov"})
        EXPECT_THAT(
            [&] {
                parse_options({"scene.pov", bad});
            },
            ThrowsMessage<Failure>(HasSubstr("argument '")))
            << bad;
    EXPECT_THAT(
        [] {
            parse_options({"scene.pov", ""});
        },
        ThrowsMessage<Failure>(HasSubstr("empty")));
}

TEST(Options, AMissingValueNamesItsOption) {
    for (const Case& c : cases()) {
        if (c.value == nullptr) continue;
        const std::string option = std::string("--") + c.name;
        SCOPED_TRACE(option);
        EXPECT_THAT(usage_error({"scene.pov", option}), HasSubstr(option));
        EXPECT_THAT(usage_error({"scene.pov", option, "--dry-run"}), HasSubstr(option));
    }
}

TEST(Options, AFlagTakesNoValue) {
    for (const Case& c : cases()) {
        if (c.value != nullptr) continue;
        const std::string option = std::string("--") + c.name;
        SCOPED_TRACE(option);
        EXPECT_THAT(usage_error({"scene.pov", option + "=7"}), HasSubstr(option));
    }
}

TEST(Options, WaysToShareRadiosity) {
    for (const char* text : {"independent", "shared", "joined"}) {
        const Options options = parse_options({"--radiosity", text, "scene.pov"});
        ASSERT_TRUE(options.radiosity);
        EXPECT_EQ(to_string(*options.radiosity), text);
        EXPECT_EQ(options.radiosity_passes, 1);
    }
    EXPECT_EQ(parse_options({"--radiosity=joined:2", "a.pov"}).radiosity_passes, 2);
    const Options last = parse_options({"--radiosity=auto", "a.pov"});
    EXPECT_FALSE(last.radiosity);
    for (const char* text : {"", "share", "shared:", "shared:0", "shared:x", "independent:1",
                             "joined:2:3", ":2", "shared:101", "joined:2147483647"})
        EXPECT_THAT(usage_error({std::string("--radiosity=") + text, "a.pov"}),
                    HasSubstr("--radiosity"))
            << text;
    EXPECT_THAT(usage_error({"--radiosity-scale", "0", "a.pov"}), HasSubstr("--radiosity-scale"));
}

TEST(Options, HelpShowsEveryOptionInItsGroup) {
    const std::string help = help_text();
    EXPECT_EQ(options_in(help), all_options());
    EXPECT_THAT(help, HasSubstr("Usage: "));
    std::size_t before = 0;
    for (const char* group : {"Cutting the image up", "Sharing the work", "Files",
                              "When something goes wrong", "What is said"}) {
        SCOPED_TRACE(group);
        const auto at = help.find(group);
        ASSERT_NE(at, std::string::npos);
        EXPECT_GT(at, before);
        before = at;
    }
    EXPECT_LT(help.find("--sections"), help.find("Sharing the work"));
    EXPECT_GT(help.find("--retries"), help.find("When something goes wrong"));
}

TEST(Options, ManualPageHasEveryOption) {
    std::string page = manual_page();
    page = std::regex_replace(page, std::regex(R"(\\f[BIR])"), " ");
    page = std::regex_replace(page, std::regex(R"(\\-)"), "-");
    EXPECT_EQ(options_in(page), all_options());
    for (const char* heading : {".SH NAME", ".SH SYNOPSIS", ".SH DESCRIPTION", ".SH EXIT STATUS"})
        EXPECT_THAT(page, HasSubstr(heading));
}

TEST(Options, ManualPageIsCleanTroff) {
    if (std::system("command -v groff >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "there is no groff on the PATH";
    const ScratchFolder scratch("options-test");
    std::ofstream(scratch.path() / "mpipov.1") << manual_page();
    const std::string command = "cd '" + scratch.path().string() +
                                "' && groff -man -Tutf8 -ww mpipov.1 >shown 2>complaints";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto read = [&](const char* name) {
        std::ifstream in(scratch.path() / name);
        return std::string{std::istreambuf_iterator<char>(in), {}};
    };
    EXPECT_EQ(read("complaints"), "");
    EXPECT_THAT(read("shown"), HasSubstr("32-pixel block grid"));
}

}  // namespace
}  // namespace mpipov
