// The program as a whole: exit codes, streams, files.
#include "image_source.h"
#include "program_test.h"
#include "run_image.h"
#include "test_image.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using OIIO::TypeDesc;
using testing::HasSubstr;

class CompareProgram : public ProgramTest {
  protected:
    CompareProgram() : ProgramTest({"compare"}) {}
    void SetUp() override {
        write_image(path("a.png"), a_, TypeDesc::UINT8);
        TestImage b = a_;
        b.at(64, 7, 1) += 5;
        write_image(path("b.png"), b, TypeDesc::UINT8);
    }

    // Of a run in 4 columns that made that image.
    RunRecord record_of(const char* image) const {
        RunRecord record = run_of(128, 32, Shape::columns, 4);
        record.pixel_sha1 = pixel_sha1(path(image));
        return record;
    }

    json read(const char* name) const {
        std::ifstream in(path(name));
        return json::parse(in);
    }

    TestImage a_ = textured(128, 32);
};

TEST_F(CompareProgram, IdenticalImages) {
    fs::copy_file(path("a.png"), path("copy.png"));
    EXPECT_EQ(run({"a.png", "copy.png", "--json", "out.json"}), 0);
    EXPECT_THAT(output_, HasSubstr("identical"));
    const json result = read("out.json");
    EXPECT_TRUE(result["identical"].get<bool>());
    EXPECT_TRUE(result["psnr"].is_null());
    EXPECT_EQ(result["ssim"]["value"], 1.0);
    EXPECT_TRUE(result["largest"].is_null());
    EXPECT_TRUE(result["differing_box"].is_null());
}

TEST_F(CompareProgram, DifferentImages) {
    EXPECT_EQ(run({"a.png", "b.png", "--json", "out.json"}), 1);
    EXPECT_THAT(output_, HasSubstr("at x 64, y 7, channel G"));
    const json result = read("out.json");
    EXPECT_EQ(result["differing"], 1);
    EXPECT_EQ(result["largest"]["x"], 64);
    EXPECT_EQ(result["largest"]["y"], 7);
    EXPECT_EQ(result["largest"]["channel"], "G");
    EXPECT_EQ(result["largest"]["levels"], 5);
    EXPECT_DOUBLE_EQ(result["largest"]["full_scale"], 5 / 255.0);
    const double ssim = result["ssim"]["value"];
    EXPECT_GT(ssim, 0.99);
    EXPECT_LT(ssim, 1.0);
    EXPECT_EQ(result["ssim"]["per_channel"]["R"], 1.0);
}

TEST_F(CompareProgram, JsonOnStandardOutputStandsAlone) {
    EXPECT_EQ(run({"a.png", "b.png", "--no-ssim", "--json", "-"}), 1);
    const json result = json::parse(output_);
    EXPECT_TRUE(result["ssim"].is_null());
    EXPECT_TRUE(result["run"].is_null());
}

TEST_F(CompareProgram, WithTheRecordOfARun) {
    write_run_record(path("run.json"), record_of("b.png"));
    EXPECT_EQ(run({"a.png", "b.png", "--no-ssim", "--run", "run.json", "--json", "out.json"}), 1);
    EXPECT_THAT(output_, HasSubstr("1 | 2 (x = 64, y 0..31): 1 touching"));
    EXPECT_THAT(output_, HasSubstr("section 2"));
    const json found = read("out.json")["run"];
    EXPECT_EQ(found["sections"][2]["differing"], 1);
    EXPECT_EQ(found["sections"][1]["differing"], 0);
    EXPECT_EQ(found["by_distance"][0]["after"]["differing"], 1);
    EXPECT_EQ(found["by_distance"].size(), 32U);
    EXPECT_EQ(found["seams"][1]["longest_run"]["length"], 1);
    EXPECT_TRUE(found["seams"][0]["longest_run"].is_null());
}

TEST_F(CompareProgram, TheRecordHasToBeOfOneOfTheImages) {
    TestImage c = a_;
    c.at(0, 0, 0) += 1;
    write_image(path("c.png"), c, TypeDesc::UINT8);
    write_run_record(path("run.json"), record_of("c.png"));
    EXPECT_EQ(run({"a.png", "b.png", "--no-ssim", "--run", "run.json"}), 4);
    EXPECT_THAT(output_, HasSubstr("'run.json' is of another image"));
    EXPECT_EQ(std::count(output_.begin(), output_.end(), '\n'), 1);
    // Of A, where B is what became of it.
    write_run_record(path("run.json"), record_of("a.png"));
    EXPECT_EQ(run({"a.png", "b.png", "--no-ssim", "--run", "run.json"}), 1);
    // Depth and type count too: the same values, stored otherwise.
    write_image(path("a.exr"), a_, TypeDesc::HALF);
    write_image(path("b.exr"), c, TypeDesc::HALF);
    EXPECT_EQ(run({"a.exr", "b.exr", "--no-ssim", "--run", "run.json"}), 4);
    write_run_record(path("run.json"), record_of("b.exr"));
    EXPECT_EQ(run({"a.exr", "b.exr", "--no-ssim", "--run", "run.json"}), 1) << output_;
}

TEST_F(CompareProgram, ARecordOfAJpegCannotBeChecked) {
    write_image(path("a.jpg"), a_, TypeDesc::UINT8);
    write_image(path("b.jpg"), textured(128, 32), TypeDesc::UINT8);
    RunRecord record = run_of(128, 32, Shape::columns, 4);
    record.plan.image.type = "jpeg";
    record.pixel_sha1 = "of the pixels before they were encoded";
    write_run_record(path("run.json"), record);
    EXPECT_EQ(run({"a.jpg", "b.jpg", "--no-ssim", "--run", "run.json"}), 0) << output_;
    EXPECT_EQ(run({"a.png", "b.png", "--no-ssim", "--run", "run.json"}), 4) << output_;
}

TEST_F(CompareProgram, TheMapIsDarkWhereTheImagesDiffer) {
    EXPECT_EQ(run({"a.png", "b.png", "--map", "map.exr"}), 1) << output_;
    ImageSource source(path("map.exr"));
    EXPECT_EQ(source.format().width, 128);
    EXPECT_EQ(source.format().channel_count(), 1);
    ImageBand band;
    ASSERT_TRUE(source.next_band(32, band));
    // One pixel differs: so does the map within the window's radius of it, and only there. (Near
    // the window's corners the weights are below the map's precision.)
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 128; ++x) {
            const int distance = std::max(std::abs(x - 64), std::abs(y - 7));
            const double value = band.row(y)[static_cast<std::size_t>(x)];
            if (distance <= 2) {
                EXPECT_LT(value, 1) << x << ',' << y;
            } else if (distance > 5) {
                EXPECT_EQ(value, 1) << x << ',' << y;
            }
        }
}

TEST_F(CompareProgram, SsimOfASmallImageHasAReason) {
    write_image(path("small.png"), textured(10, 40), TypeDesc::UINT8);
    TestImage other = textured(10, 40);
    other.at(1, 1, 1) += 1;
    write_image(path("other.png"), other, TypeDesc::UINT8);
    EXPECT_EQ(run({"small.png", "other.png", "--json", "out.json"}), 1);
    const json result = read("out.json");
    EXPECT_TRUE(result["ssim"]["value"].is_null());
    EXPECT_THAT(result["ssim"]["reason"].get<std::string>(), HasSubstr("11 x 11"));
    EXPECT_EQ(run({"small.png", "other.png", "--map", "map.png"}), 4);
    EXPECT_THAT(output_, HasSubstr("map.png"));
    EXPECT_FALSE(fs::exists(path("map.png")));
}

TEST_F(CompareProgram, TheSignOfZeroIsSeenInAFile) {
    TestImage a = a_, b = a_;
    a.at(5, 6, 0) = 0.0;
    b.at(5, 6, 0) = -0.0;
    for (const auto& type : {TypeDesc::HALF, TypeDesc::FLOAT}) {
        write_image(path("a.exr"), a, type);
        write_image(path("b.exr"), b, type);
        EXPECT_EQ(run({"a.exr", "b.exr", "--no-ssim", "--json", "out.json"}), 1) << output_;
        EXPECT_THAT(output_, HasSubstr("1 samples are 0 in one and -0 in the other"));
        EXPECT_EQ(read("out.json")["zero_signs"], 1);
        EXPECT_EQ(read("out.json")["differing"], 1);
        EXPECT_TRUE(read("out.json")["largest"].is_null());
    }
}

TEST_F(CompareProgram, SsimOfFloatsWithNaN) {
    TestImage b = a_;
    b.at(100, 20, 0) = std::numeric_limits<double>::quiet_NaN();
    write_image(path("a.exr"), a_, TypeDesc::HALF);
    write_image(path("b.exr"), b, TypeDesc::HALF);
    EXPECT_EQ(run({"a.exr", "b.exr", "--json", "out.json"}), 1);
    const json result = read("out.json");
    EXPECT_EQ(result["nonfinite"]["first"][0]["x"], 100);
    EXPECT_EQ(result["nonfinite"]["first"][0]["value"], "nan");
    EXPECT_TRUE(result["ssim"]["value"].is_null());
    EXPECT_TRUE(result["rms"]["levels"].is_null());
}

TEST_F(CompareProgram, UsageErrors) {
    EXPECT_EQ(run({"a.png"}), 2);
    EXPECT_THAT(output_, HasSubstr("mpipov-validate: "));
    EXPECT_EQ(run({"a.png", "b.png", "--nonsense"}), 2);
    EXPECT_EQ(run({"a.png", "b.png", "--ssim", "--no-ssim"}), 2);
    EXPECT_EQ(run({"a.png", "b.png", "--no-ssim", "--map", "map.png"}), 2);
    for (const char* peak : {"0", "-1", "nan", "inf", "-inf", "1e999", "one"}) {
        EXPECT_EQ(run({"a.png", "b.png", "--no-ssim", "--peak", peak}), 2) << peak;
        EXPECT_THAT(output_, HasSubstr("--peak"));
    }
    EXPECT_EQ(run({"a.png", "b.png", "--no-ssim", "--peak", "2e3"}), 1);
    EXPECT_EQ(run({"--help"}), 0);
}

TEST_F(CompareProgram, NothingThatIsReadIsOverwritten) {
    write_run_record(path("run.json"), record_of("b.png"));
    fs::create_symlink("a.png", path("link.png"));
    fs::create_hard_link(path("b.png"), path("other.png"));
    const std::vector<std::vector<std::string>> refused{{"--json", "a.png"},
                                                        {"--json", "./b.png"},
                                                        {"--json", "link.png"},
                                                        {"--json", "other.png"},
                                                        {"--json", path("b.png").string()},
                                                        {"--json", "run.json"},
                                                        {"--map", "a.png"},
                                                        {"--map", "b.png"},
                                                        {"--map", "link.png"},
                                                        {"--map", "x.exr", "--json", "./x.exr"}};
    for (const auto& more : refused) {
        std::vector<std::string> arguments{"a.png", "b.png", "--run", "run.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(run(arguments), 2) << more[0] << ' ' << more[1];
        EXPECT_THAT(output_, HasSubstr("mpipov-validate: " + more[0] + " would overwrite"));
    }
    EXPECT_EQ(run({"a.png", "b.png", "--no-ssim"}), 1) << "they are as they were";
    EXPECT_TRUE(fs::is_symlink(path("link.png")));
}

TEST_F(CompareProgram, ADeviceIsWrittenToAndNotReplaced) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    const int pipe = ::open(path("pipe").c_str(), O_RDWR | O_NONBLOCK);
    ASSERT_GE(pipe, 0);
    EXPECT_EQ(run({"a.png", "b.png", "--no-ssim", "--json", "pipe"}), 1);
    std::string found(1 << 16, ' ');
    found.resize(
        static_cast<std::size_t>(std::max(ssize_t{0}, ::read(pipe, found.data(), found.size()))));
    ::close(pipe);
    EXPECT_TRUE(fs::is_fifo(path("pipe")));
    EXPECT_EQ(json::parse(found)["differing"], 1);
}

TEST_F(CompareProgram, ADamagedImageIsOneLine) {
    for (const char* type : {"png", "bmp", "tga", "ppm", "exr"}) {
        const std::string whole = fmt::format("whole.{}", type), cut = fmt::format("cut.{}", type);
        const bool exr = std::string_view(type) == "exr";
        write_image(path(whole), a_, exr ? TypeDesc::HALF : TypeDesc::UINT8);
        for (const int parts : {2, 100}) {  // in the pixels, in the header
            fs::copy_file(path(whole), path(cut), fs::copy_options::overwrite_existing);
            fs::resize_file(path(cut), fs::file_size(path(whole)) / parts);
            EXPECT_EQ(run({cut, whole, "--no-ssim"}), 4) << type;
            EXPECT_EQ(std::count(output_.begin(), output_.end(), '\n'), 1) << output_;
            EXPECT_THAT(output_,
                        HasSubstr(fmt::format("mpipov-validate: cannot read '{}': ", cut)));
            EXPECT_THAT(output_, testing::Not(HasSubstr("unknown error")));
        }
    }
}

TEST_F(CompareProgram, WhatCannotBePrintedIsAnError) {
    const std::vector<std::vector<std::string>> all{{"a.png", "b.png", "--no-ssim"},
                                                    {"a.png", "a.png", "--no-ssim"},
                                                    {"a.png", "b.png", "--no-ssim", "--json", "-"},
                                                    {"--help"}};
    for (const auto& arguments : all) {
        EXPECT_EQ(run_on_full_disk(arguments), 4) << arguments.back();
        EXPECT_THAT(output_, testing::MatchesRegex("mpipov-validate: cannot write to [^\n]*: No "
                                                   "space left on device\n"));
    }
}

TEST_F(CompareProgram, FileErrors) {
    EXPECT_EQ(run({"a.png", "none.png"}), 4);
    EXPECT_THAT(output_, HasSubstr("mpipov-validate: cannot read 'none.png': no such file"));
    EXPECT_EQ(run({"a.png", "b.png", "--run", "none.json"}), 4);
    EXPECT_THAT(output_, HasSubstr("none.json"));
    for (const char* text : {"", "{", "[]", "{}", R"({"format": "mpipov-run", "version": 7})"}) {
        std::ofstream(path("bad.json")) << text;
        EXPECT_EQ(run({"a.png", "b.png", "--run", "bad.json"}), 4) << text;
        EXPECT_THAT(output_, HasSubstr("mpipov-validate: cannot read 'bad.json': "));
        EXPECT_THAT(output_, testing::Not(HasSubstr("json.exception"))) << text;
    }
    EXPECT_EQ(run({"a.png", "b.png", "--no-ssim", "--json", "no/out.json"}), 4);
    EXPECT_THAT(output_, HasSubstr("no/out.json"));
}

}  // namespace
}  // namespace mpipov
