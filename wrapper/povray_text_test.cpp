// The recorded texts are made by testdata/record.
#include "povray_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace mpipov {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Optional;
using testing::Pair;
using testing::SizeIs;
using testing::StartsWith;

std::string recorded(const std::string& name) {
    const auto file = std::filesystem::path(MPIPOV_TESTDATA) / (name + ".txt");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error("no recorded text " + file.string());
    return {std::istreambuf_iterator<char>(in), {}};
}

ImageOptions image_options(const std::string& name) {
    const auto options = parse_image_options(recorded(name));
    if (!options) throw std::runtime_error(name + " has no image options");
    return *options;
}

TEST(PovrayText, ReadsThePlainImage) {
    const ImageOptions options = image_options("plain");
    EXPECT_EQ(options.input_file, "none.pov");
    EXPECT_EQ(options.width, 64);
    EXPECT_EQ(options.height, 48);
    EXPECT_EQ(options.region, (Rect{0, 0, 64, 48}));
    EXPECT_EQ(options.output_file, "out.png");
    EXPECT_EQ(options.type, "PNG");
    EXPECT_EQ(options.bits_per_pixel, 24);
    EXPECT_FALSE(options.alpha);
    EXPECT_FALSE(options.rle);
    EXPECT_FALSE(options.to_standard_output);
    EXPECT_EQ(options.dithering, "Off");
    EXPECT_FALSE(options.animation);
    EXPECT_EQ(options.frames, 1);
}

struct OutputCase {
    const char* text;
    const char* file;
    const char* type;
    int bits;
    bool alpha, rle;
    int quality;
};

void PrintTo(const OutputCase& c, std::ostream* out) {
    *out << c.text;
}

class PovrayTextOutput : public testing::TestWithParam<OutputCase> {};

TEST_P(PovrayTextOutput, IsRead) {
    const ImageOptions options = image_options(GetParam().text);
    EXPECT_EQ(options.output_file, GetParam().file);
    EXPECT_EQ(options.type, GetParam().type);
    EXPECT_EQ(options.bits_per_pixel, GetParam().bits);
    EXPECT_EQ(options.alpha, GetParam().alpha);
    EXPECT_EQ(options.rle, GetParam().rle);
    EXPECT_EQ(options.jpeg_quality, GetParam().quality);
    EXPECT_EQ(options.width, 32);
    EXPECT_EQ(options.height, 24);
}

INSTANTIATE_TEST_SUITE_P(
    Types, PovrayTextOutput,
    testing::Values(OutputCase{"jpeg", "out.jpg", "JPEG", 24, false, false, 60},
                    OutputCase{"jpeg_alpha", "out.jpg", "JPEG", 32, true, false, 60},
                    OutputCase{"exr_alpha", "out.exr", "EXR", 32, true, false, 0},
                    OutputCase{"grayscale", "out.png", "PNG", 0, false, false, 0},
                    OutputCase{"targa_rle", "out.tga", "Targa", 24, false, true, 0},
                    OutputCase{"ppm", "out.ppm", "PPM", 48, false, false, 0},
                    OutputCase{"hdr", "out.hdr", "HDR", 24, false, false, 0},
                    OutputCase{"bmp", "out.bmp", "BMP", 24, false, false, 0}),
    [](const auto& test_case) { return test_case.param.text; });

TEST(PovrayText, ReadsDithering) {
    EXPECT_EQ(image_options("dithering").dithering, "Floyd-Steinberg error diffusion");
    EXPECT_EQ(image_options("dithering_d2").dithering, "simple 2-D error diffusion");
    EXPECT_EQ(image_options("bayer").dithering, "4x4 Bayer pattern");
}

TEST(PovrayText, ReadsARegionAsHalfOpenPixels) {
    EXPECT_EQ(image_options("region").region, (Rect{2, 0, 16, 7}));
}

TEST(PovrayText, CountsTheFramesToRenderNotThoseOfTheAnimation) {
    const ImageOptions one = image_options("animation");
    EXPECT_TRUE(one.animation);
    EXPECT_EQ(one.frames, 1);
    EXPECT_EQ(one.output_file, "out2.png");
    EXPECT_EQ(image_options("frames").frames, 3);
}

TEST(PovrayText, KnowsWhereNoFileIsWritten) {
    EXPECT_THAT(image_options("nothing_written").output_file, IsEmpty());
    EXPECT_TRUE(image_options("standard_output").to_standard_output);
}

TEST(PovrayText, PutsPathsTogetherThatWereBrokenAtColumn80) {
    const ImageOptions broken = image_options("long_paths");
    const std::string folder =
        "/tmp/x/a_folder_whose_name_alone_is_so_long_that_a_line_cannot_hold_it_whole/";
    EXPECT_EQ(broken.input_file, folder + "none.pov");
    EXPECT_EQ(broken.output_file, folder + "and_a_picture_whose_name_is_long_as_well.png");
    EXPECT_EQ(image_options("spaced_path").output_file,
              "/tmp/x/a folder with many short words in its name so that lines end at a space/"
              "b c d e f/my picture.png");
}

TEST(PovrayText, NoImageOptionsWhereNoneWerePrinted) {
    EXPECT_FALSE(parse_image_options(""));
    EXPECT_FALSE(parse_image_options(recorded("unknown_option")));
    EXPECT_FALSE(parse_image_options(recorded("version")));
}

TEST(PovrayText, ReportsAPlainRender) {
    const LaunchReport report = parse_report(recorded("plain"));
    EXPECT_TRUE(report.finished);
    EXPECT_FALSE(report.photons);
    EXPECT_FALSE(report.radiosity);
    EXPECT_FALSE(report.antialiasing.on);
    EXPECT_GT(report.parse_seconds, 0);
    EXPECT_GT(report.trace_seconds, 0);
    EXPECT_EQ(report.photon_seconds, 0);
    EXPECT_EQ(report.radiosity_cpu, 0);
    EXPECT_EQ(report.counters.at("Pixels"), 64 * 48);
    EXPECT_EQ(report.counters.at("Finite Objects"), 4);
    EXPECT_THAT(report.counters, Not(testing::Contains(Pair("Media Samples", testing::_))));
}

TEST(PovrayText, ReportsAntialiasing) {
    const Antialiasing two = parse_report(recorded("antialiased")).antialiasing;
    EXPECT_TRUE(two.on);
    EXPECT_EQ(two.method, 2);
    EXPECT_EQ(two.depth, 4);
    EXPECT_DOUBLE_EQ(two.threshold, 0.2);
    const Antialiasing one = parse_report(recorded("radiosity")).antialiasing;
    EXPECT_TRUE(one.on);
    EXPECT_EQ(one.method, 1);
    EXPECT_EQ(one.depth, 3);
    EXPECT_DOUBLE_EQ(one.threshold, 0.3);
}

// Every time has two lines, and they must not be mixed up: the numbers here are read from the text
// by their place in it.
TEST(PovrayText, ReportsRadiosityTimes) {
    const std::string text = recorded("radiosity");
    const LaunchReport report = parse_report(text);
    EXPECT_TRUE(report.radiosity);
    EXPECT_FALSE(report.photons);
    const auto number_after = [&text](const char* label, const char* before) {
        const auto line = text.find(label);
        return std::stod(text.substr(text.find(before, line) + std::string(before).size()));
    };
    EXPECT_DOUBLE_EQ(report.radiosity_seconds, number_after("Radiosity Time:", "("));
    EXPECT_DOUBLE_EQ(report.radiosity_cpu, number_after("Radiosity Time:", " with "));
    EXPECT_DOUBLE_EQ(report.trace_seconds, number_after("Trace Time:", "("));
    EXPECT_DOUBLE_EQ(report.trace_cpu, number_after("Trace Time:", " with "));
    EXPECT_DOUBLE_EQ(report.parse_cpu, number_after("Parse Time:", " with "));
    EXPECT_GT(report.radiosity_cpu, report.trace_cpu);
}

TEST(PovrayText, ReportsPhotonsMediaAndIsosurfaces) {
    const LaunchReport report = parse_report(recorded("benchmark"));
    EXPECT_TRUE(report.photons);
    EXPECT_FALSE(report.radiosity);
    EXPECT_GT(report.photon_cpu, 0.1);
    EXPECT_GT(report.photon_seconds, 0.1);
    for (const char* name : {"Media Samples", "Isosurface roots", "Reflected Rays",
                             "Refracted Rays", "Transmitted Rays", "Number of photons shot"}) {
        SCOPED_TRACE(name);
        ASSERT_TRUE(report.counters.count(name));
        EXPECT_GT(report.counters.at(name), 1000);
    }
}

TEST(PovrayText, AFailedLaunchIsNotFinished) {
    for (const char* name : {"syntax_error", "terminated", "no_output_folder", "missing_input"}) {
        SCOPED_TRACE(name);
        EXPECT_FALSE(parse_report(recorded(name)).finished);
    }
}

TEST(PovrayText, ProgressIsTheLastOneOfManyInALine) {
    EXPECT_THAT(
        parse_progress("Rendered 1024 of 3072 pixels (33%)\rRendered 1536 of 3072 pixels (50%)\r"),
        Optional(0.5));
    EXPECT_THAT(parse_progress("Rendered 768 of 3072 pixels (25%)\rRendered 1536 of 3072 pix"),
                Optional(0.25));
    EXPECT_THAT(parse_progress(recorded("plain")), Optional(1.0));
    EXPECT_FALSE(parse_progress(recorded("syntax_error")));
    EXPECT_FALSE(parse_progress("Rendered 0 of 0 pixels"));
    EXPECT_FALSE(parse_progress("Rendered 12"));
}

TEST(PovrayText, WarningsAreWholeAndEachOnce) {
    const std::vector<std::string> warnings = parse_warnings(recorded("warnings"));
    // POV-Ray itself ends a long #warning with three dots.
    EXPECT_THAT(
        warnings,
        ElementsAre(
            "File 'warnings.pov' line 1: Parse Warning: short",
            "File 'warnings.pov' line 2: Parse Warning: short",
            "File 'warnings.pov' line 3: Parse Warning: a warning that goes on and on, over more "
            "than one line of eighty columns, and names "
            "/a/file/name/without/any/blank/in/it/tha...",
            AllOf(StartsWith("Parse Warning: assumed_gamma not specified, so gamma_correction is "
                             "turned off for compatibility"),
                  EndsWith("for more details.")),
            AllOf(StartsWith("Parse Warning: This scene did not contain a #version directive. "),
                  EndsWith("presence of a #version statement mandatory."))));
    const std::string twice = "Parse Warning: once\nParse Warning: once\n";
    EXPECT_THAT(parse_warnings(twice), ElementsAre("Parse Warning: once"));
    EXPECT_THAT(parse_warnings(recorded("plain")), IsEmpty());
    EXPECT_THAT(parse_warnings(recorded("benchmark")),
                ElementsAre("File 'benchmark.pov' line 171: Parse Warning: New instance of "
                            "assumed_gamma ignored"));
}

TEST(PovrayText, ErrorsSayWhatAndWhere) {
    EXPECT_EQ(parse_error(recorded("syntax_error")),
              "File 'syntax_error.pov' line 2: Parse Error: No matching } in 'sphere', End of File "
              "found instead");
    EXPECT_EQ(parse_error(recorded("hash_error")),
              "File 'hash_error.pov' line 2: Parse Error: Parse halted by #error directive: the "
              "author says no, at some length, so that this line is longer than eighty columns");
    EXPECT_THAT(parse_error(recorded("missing_include")),
                AllOf(StartsWith("File 'missing_include.pov' line 2: "),
                      HasSubstr("no_such_file_anywhere.inc")));
    EXPECT_THAT(parse_error(recorded("missing_image")),
                AllOf(StartsWith("File 'missing_image.pov' line 2: "),
                      HasSubstr("Cannot find file 'no_such_image.png'")));
    EXPECT_THAT(parse_error(recorded("missing_input")), HasSubstr("'no_such_scene.pov'"));
    EXPECT_EQ(parse_error(recorded("no_output_folder")), "Cannot create render state output file.");
    EXPECT_EQ(parse_error(recorded("unwritable")), "Cannot create render state output file.");
    EXPECT_THAT(parse_error(recorded("terminated")), HasSubstr("Frontend halted render"));
}

TEST(PovrayText, AMerelyPossibleErrorDoesNotHideTheRealOne) {
    EXPECT_EQ(parse_error("File 'a.pov' line 1: Possible Parse Error: a doubt\n"
                          "File 'a.pov' line 2: Parse Warning: unrelated\n"
                          "File 'a.pov' line 9: Parse Error: the reason\n"),
              "File 'a.pov' line 9: Parse Error: the reason");
}

TEST(PovrayText, TheLongCommandIsNotTakenForTheReason) {
    for (const char* name : {"unknown_option", "unknown_setting", "bad_value"}) {
        SCOPED_TRACE(name);
        EXPECT_TRUE(is_option_error(recorded(name)));
        EXPECT_EQ(parse_error(recorded(name)),
                  "Problem with option setting: Failed to parse command-line option");
    }
    EXPECT_EQ(parse_error(recorded("no_input")),
              "Problem with option setting: No input file provided");
    EXPECT_FALSE(is_option_error(recorded("syntax_error")));
    EXPECT_FALSE(is_option_error(recorded("missing_input")));
}

TEST(PovrayText, AnErrorIsNeverEmpty) {
    EXPECT_EQ(parse_error(""), "it printed nothing");
    EXPECT_EQ(parse_error("\n \n"), "it printed nothing");
    EXPECT_EQ(parse_error("povray: exec failed\n\n"), "povray: exec failed");
    EXPECT_THAT(parse_error("Problem with option setting\n"), Not(IsEmpty()));
}

TEST(PovrayText, VersionOfBothTexts) {
    EXPECT_THAT(parse_version(recorded("version")), Optional(StartsWith("3.7.")));
    EXPECT_EQ(parse_version(recorded("plain")), parse_version(recorded("version")));
    EXPECT_FALSE(parse_version("sh: povray: not found"));
}

TEST(PovrayText, SettingsOfTheIniThatPovrayWrites) {
    const auto settings = parse_ini(recorded("settings"));
    EXPECT_EQ(settings.at("render_block_size"), "64");
    EXPECT_EQ(settings.at("width"), "32");
    EXPECT_EQ(settings.at("input_file_name"), "none.pov");
    EXPECT_EQ(settings.at("library_path"), "/usr/share/povray-3.7/include");
    EXPECT_THAT(parse_ini("; a=b\n  Key = \"x=y\" \nnothing\n"), ElementsAre(Pair("key", "x=y")));
    EXPECT_THAT(ini_settings("Key=b\nA=\"1\"\nKey=a\n"),
                ElementsAre(Pair("Key", "b"), Pair("A", "1"), Pair("Key", "a")));
}

TEST(PovrayText, UnwrapKeepsShortLinesApart) {
    EXPECT_THAT(unwrap_lines("one\n two\nthree"), ElementsAre("one", " two", "three"));
    const std::string full(80, 'x');
    EXPECT_THAT(unwrap_lines(full + "\n" + full + "\nend\nnext"),
                ElementsAre(full + full + "end", "next"));
    EXPECT_THAT(unwrap_lines(full + "\nFile 'a.pov' line 1"),
                ElementsAre(full, "File 'a.pov' line 1"));
    const std::string rule(76, '-');
    EXPECT_THAT(unwrap_lines(rule + "\n  Photon Time:"), ElementsAre(rule, "  Photon Time:"));
}

// POV-Ray's text may be cut anywhere, by the end of a process or of the buffer.
TEST(PovrayText, CutTextsDoNoHarm) {
    for (const char* name : {"benchmark", "warnings", "unknown_option", "frames"}) {
        const std::string text = recorded(name);
        for (std::size_t size = 0; size <= text.size(); size += 211) {
            const std::string cut = text.substr(0, size);
            parse_image_options(cut);
            const LaunchReport report = parse_report(cut);
            EXPECT_GE(report.trace_cpu, 0);
            parse_warnings(cut);
            const auto progress = parse_progress(cut);
            EXPECT_TRUE(!progress || (*progress >= 0 && *progress <= 1));
            EXPECT_THAT(parse_error(cut), Not(IsEmpty()));
        }
    }
}

TEST(StatisticsArePrinted, OnceTheirLastLineIsWhole) {
    const std::string whole = recorded("plain");
    ASSERT_TRUE(statistics_are_printed(whole));
    const std::string last = " CPU-seconds total\n";
    const std::size_t end = whole.rfind(last);
    ASSERT_NE(end, std::string::npos);
    EXPECT_TRUE(statistics_are_printed(whole.substr(0, end + last.size())));
    // The times of parsing end in the same words.
    for (std::size_t cut = 1; cut < 600; cut += 7)
        EXPECT_FALSE(statistics_are_printed(whole.substr(0, end + last.size() - cut))) << cut;
    EXPECT_FALSE(statistics_are_printed(""));
    EXPECT_FALSE(statistics_are_printed(recorded("syntax_error")));
}

// std::regex recurses once a character: each of these ended the program. A scene prints what it
// likes, and line feeds are taken out of it.
TEST(LongLines, DoNotOverflowTheStack) {
    const std::string word(1000000, 'A'), number(1000000, '1');
    EXPECT_FALSE(parse_report(word).finished);
    EXPECT_TRUE(parse_report(word + ": 7\n\nPOV-Ray finished\n").finished);
    EXPECT_EQ(parse_report("  Parse Time: (" + number + " seconds)\n").parse_seconds, 0);
    EXPECT_EQ(parse_version("POV-Ray 3" + number), "3" + number);
    EXPECT_FALSE(parse_image_options("  Output file.........." + word + ", 24 bpp PNG\n"));
    EXPECT_THAT(parse_warnings("File '" + word + "' line 1: Parse Warning: a\n"), SizeIs(1));
    EXPECT_EQ(parse_error("Possible " + word + "\n"), "Possible " + word);
}

// By hand it takes half a minute for each 100 000 where each is compared with all others.
TEST(ManyWarnings, TakeLinearTime) {
    std::string text;
    for (int i = 0; i < 300000; ++i) text += fmt::format("Warning: {}\n", i);
    EXPECT_THAT(parse_warnings(text), SizeIs(300000));
}

}  // namespace
}  // namespace mpipov
