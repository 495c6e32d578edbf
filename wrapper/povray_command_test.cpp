#include "povray_command.h"

#include "child_process.h"
#include "povray_text.h"
#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

namespace mpipov {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

constexpr ImageSize size{64, 48};

TEST(PovrayCommand, AreasAreOneBasedAndInclusive) {
    EXPECT_THAT(area_arguments({10, 20, 30, 40}), ElementsAre("+SC11", "+EC30", "+SR21", "+ER40"));
}

// +SC1 would be 100 %, which is the last column.
TEST(PovrayCommand, AStartAtTheFirstPixelIsZero) {
    EXPECT_THAT(area_arguments({0, 0, 64, 48}), ElementsAre("+SC0", "+EC64", "+SR0", "+ER48"));
}

TEST(PovrayCommand, NothingEndsAtOne) {
    for (int x0 = 0; x0 < 5; ++x0)
        for (int x1 = x0 + 1; x1 <= 5; ++x1)
            for (int y0 = 0; y0 < 4; ++y0)
                for (int y1 = y0 + 1; y1 <= 4; ++y1) {
                    const Rect render{x0, y0, x1, y1};
                    const Rect area = launch_area(render, {5, 4});
                    EXPECT_EQ(intersect(area, render), render);
                    EXPECT_EQ(intersect(area, {0, 0, 5, 4}), area);
                    EXPECT_LE(area.area() - render.area(), render.width() + render.height() + 1);
                    EXPECT_THAT(area_arguments(area), Not(Contains("+EC1")));
                    EXPECT_THAT(area_arguments(area), Not(Contains("+ER1")));
                    EXPECT_THAT(area_arguments(area), Not(Contains("+SC1")));
                    EXPECT_THAT(area_arguments(area), Not(Contains("+SR1")));
                }
    EXPECT_EQ(launch_area({3, 2, 9, 7}, size), (Rect{3, 2, 9, 7}));
}

// Of one pixel, 100 % is all there is.
TEST(PovrayCommand, AnImageOneWideIsRenderedAsItIs) {
    EXPECT_EQ(launch_area({0, 0, 1, 1}, {1, 1}), (Rect{0, 0, 1, 1}));
    EXPECT_EQ(launch_area({0, 0, 1, 5}, {1, 9}), (Rect{0, 0, 1, 5}));
    EXPECT_EQ(launch_area({0, 0, 5, 1}, {9, 1}), (Rect{0, 0, 5, 1}));
}

TEST(PovrayCommand, OursComeAfterTheUsersAndTheOutputLast) {
    JobCommand job;
    job.povray = "/opt/povray";
    job.user_arguments = {"scene.pov", "+W64", "+H48", "+A0.3", "-WT4", "+Oelsewhere"};
    job.format_arguments = {"+FP8"};
    const auto argv = section_command(job, {0, 0, 32, 48}, size, "/tmp/a b/7");
    ASSERT_GE(argv.size(), 8u);
    EXPECT_EQ(argv.front(), "/opt/povray");
    EXPECT_EQ(std::vector(argv.begin() + 1, argv.begin() + 7), job.user_arguments);
    EXPECT_EQ(argv[7], "+FP8");
    EXPECT_EQ(argv.back(), "+O\"/tmp/a b/7\"");
    for (const char* ours : {"-D", "-P", "-C", "+V", "Create_Ini=", "All_Console=on", "+SC0",
                             "+EC32", "+SR0", "+ER48", "+WT1"}) {
        SCOPED_TRACE(ours);
        EXPECT_EQ(std::count(argv.begin() + 7, argv.end(), ours), 1);
    }
}

TEST(PovrayCommand, ThreadsAndBlocksAreTheJobs) {
    JobCommand job;
    job.user_arguments = {"scene.pov", "+BS64"};
    EXPECT_THAT(section_command(job, {0, 0, 32, 48}, size, "x"),
                Not(Contains(testing::AllOf(testing::StartsWith("+BS"), testing::Ne("+BS64")))));
    job.threads = 3;
    job.block = 64;
    const auto argv = section_command(job, {0, 0, 32, 48}, size, "x");
    EXPECT_THAT(argv, Contains("+WT3"));
    EXPECT_EQ(std::count(argv.begin(), argv.end(), "+BS64"), 2);
}

TEST(PovrayCommand, ASectionThatEndsAtOneIsLaunchedLarger) {
    EXPECT_THAT(section_command({}, {0, 0, 1, 48}, size, "x"), Contains("+EC2"));
    EXPECT_THAT(section_command({}, {0, 0, 64, 1}, size, "x"), Contains("+ER2"));
}

TEST(PovrayCommand, QuotesFileNamesWithBlanks) {
    const auto quoted = [](const std::string& argument) { return quote_arguments({argument})[0]; };
    EXPECT_EQ(quoted("my scene.pov"), "\"my scene.pov\"");
    EXPECT_EQ(quoted("+Imy scene.pov"), "+I\"my scene.pov\"");
    EXPECT_EQ(quoted("-Omy picture.png"), "-O\"my picture.png\"");
    EXPECT_EQ(quoted("+omy picture.png"), "+o\"my picture.png\"");
    EXPECT_EQ(quoted("+Lmy lib"), "+L\"my lib\"");
    EXPECT_EQ(quoted("+HImy header.inc"), "+HI\"my header.inc\"");
    EXPECT_EQ(quoted("+RFmy cache"), "+RF\"my cache\"");
    EXPECT_EQ(quoted("+GImy settings.ini"), "+GI\"my settings.ini\"");
    EXPECT_EQ(quoted("Output_File_Name=my picture.png"), "Output_File_Name=\"my picture.png\"");
    EXPECT_EQ(quoted("the \"best\" scene.pov"), "'the \"best\" scene.pov'");
}

TEST(PovrayCommand, LeavesAllElseAsItIs) {
    const std::vector<std::string> arguments{"scene.pov",
                                             "+W64",
                                             "+W320 +H240",
                                             "Width=320 Height=240",
                                             "+I\"my scene.pov\"",
                                             "'a b.pov'",
                                             "",
                                             "-D",
                                             "+A0.3 -C",
                                             "+FN16 +UA"};
    EXPECT_EQ(quote_arguments(arguments), arguments);
    EXPECT_THAT(quote_arguments({}), IsEmpty());
}

TEST(PovrayCommand, PovrayTakesEveryAreaAsItIsMeant) {
    if (std::system("command -v povray >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "there is no povray on the PATH";
    const ScratchFolder scratch("povray-command-test");
    // It prints what it would render, and stops.
    const std::filesystem::path scene = scratch.path() / "stop.pov";
    std::ofstream(scene) << "#error \"enough\"\n";
    JobCommand job;
    job.user_arguments = {"+I" + scene.string(), "+W5", "+H4"};
    const std::vector<Rect> rects{{0, 0, 5, 4}, {0, 0, 1, 1}, {1, 1, 2, 2}, {4, 3, 5, 4},
                                  {2, 0, 3, 1}, {0, 2, 1, 3}, {1, 0, 4, 2}};
    std::vector<ChildProcess> launches;
    for (const Rect& rect : rects) {
        ChildRequest request;
        request.argv = section_command(job, rect, {5, 4}, scratch.path() / "out");
        request.timeout_seconds = 30;
        launches.push_back(ChildProcess::start(request));
    }
    for (std::size_t i = 0; i < rects.size(); ++i) {
        while (!launches[i].poll()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        const auto printed = parse_image_options(launches[i].output());
        ASSERT_TRUE(printed) << launches[i].output();
        EXPECT_EQ(printed->region, launch_area(rects[i], {5, 4}))
            << testing::PrintToString(section_command(job, rects[i], {5, 4}, "out"));
    }
}

TEST(PovrayCommand, OnlyJpegAndTargaAreStoredDifferently) {
    EXPECT_THAT(section_format("JPEG"), ElementsAre("+FP8"));
    EXPECT_THAT(section_format("Targa"), ElementsAre("+FN8"));
    for (const char* type : {"PNG", "EXR", "HDR", "BMP", "PPM"})
        EXPECT_THAT(section_format(type), IsEmpty());
}

TEST(PovrayCommand, ACacheOfTheJobIsRead) {
    JobCommand job;
    job.radiosity_cache = "some where/radiosity.cache";
    const auto argv = section_command(job, {0, 0, 8, 8}, {32, 32}, "out");
    EXPECT_THAT(
        argv, testing::IsSupersetOf({"+RFI", "-RFO", "-RVP", "+RF\"some where/radiosity.cache\""}));
    EXPECT_EQ(argv.back(), "+O\"out\"");
}

TEST(PovrayCommand, GatheringWritesSamplesAndNoImage) {
    JobCommand job;
    job.user_arguments = {"scene.pov", "+W320", "+A0.1", "+RFI"};
    const auto first = gather_command(job, {0, 0, 8, 8}, {32, 32}, "out", false);
    EXPECT_THAT(first, testing::IsSupersetOf({"+W32", "+H32", "-A", "-F", "-RFI", "+RFO",
                                              "+RF\"out\"", "+EC8", "+ER8"}));
    EXPECT_THAT(first, testing::Not(testing::Contains("-RVP")));
    EXPECT_THAT(first, testing::Not(testing::Contains(testing::StartsWith("+O"))));
    // Ours are the last ones, which POV-Ray takes.
    EXPECT_LT(std::find(first.begin(), first.end(), "+W320"),
              std::find(first.begin(), first.end(), "+W32"));
    const auto later = gather_command(job, {0, 0, 8, 8}, {32, 32}, "out", true);
    EXPECT_THAT(later, testing::IsSupersetOf({"+RFI", "+RFO", "-RVP"}));
}

TEST(WholeCommand, IsASectionsWithoutAnArea) {
    JobCommand job;
    job.user_arguments = {"scene.pov", "+W64"};
    job.threads = 3;
    std::vector<std::string> section = section_command(job, {0, 0, 64, 48}, {64, 48}, "/tmp/x");
    std::erase_if(section, [](const std::string& argument) {
        return argument.rfind("+S", 0) == 0 || argument.rfind("+E", 0) == 0;
    });
    EXPECT_EQ(whole_command(job, "/tmp/x"), section);
}

}  // namespace
}  // namespace mpipov
