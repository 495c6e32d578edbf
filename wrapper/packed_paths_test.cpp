#include "packed_paths.h"

#include <gtest/gtest.h>

namespace mpipov {
namespace {

PackedPaths paths() {
    return {"/home/u/job", {"../lib", "/data/maps"}, {"scene.pov", "sub/a.inc"}};
}

TEST(PackedPaths, TheCopyHoldsWhatIsNamedAndNoMoreOfTheTree) {
    const PackedPaths here("/home/u/job", {}, {"scene.pov", "sub/a.inc"});
    EXPECT_EQ(here.name_of(""), "scene");
    EXPECT_EQ(here.name_of("scene.pov"), "scene/scene.pov");
    EXPECT_EQ(here.name_of("/home/u/job/sub/a.inc"), "scene/sub/a.inc");
    const PackedPaths above("/home/u/job", {"../lib"}, {"scene.pov", "../lib/a.inc"});
    EXPECT_EQ(above.name_of(""), "scene/job");
    EXPECT_EQ(above.name_of("../lib/a.inc"), "scene/lib/a.inc");
    EXPECT_EQ(above.name_of("../lib/"), "scene/lib");
    EXPECT_EQ(paths().name_of(""), "scene/home/u/job");
    EXPECT_EQ(paths().name_of("/data/maps/x.png"), "scene/data/maps/x.png");
    EXPECT_EQ(PackedPaths("/", {}, {"/a.pov"}).name_of("a.pov"), "scene/a.pov");
}

TEST(PackedPaths, AbsoluteNamesInOptionsBecomeRelative) {
    EXPECT_EQ(paths().mapped_option("/home/u/job/scene.pov"), "scene.pov");
    EXPECT_EQ(paths().mapped_option("/home/u/job"), ".");
    EXPECT_EQ(paths().mapped_option("+I/home/u/job/scene.pov"), "+Iscene.pov");
    EXPECT_EQ(paths().mapped_option("+L/data/maps"), "+L../../../data/maps");
    EXPECT_EQ(paths().mapped_option("+l\"/data/my maps\""), "+l\"../../../data/my maps\"");
    EXPECT_EQ(paths().mapped_option("'/data/my maps/a.ini'"), "'../../../data/my maps/a.ini'");
    EXPECT_EQ(paths().mapped_option("/home/u/lib/job.ini[Large]"), "../lib/job.ini[Large]");
    EXPECT_EQ(paths().mapped_option("+HI/home/u/lib/h.inc"), "+HI../lib/h.inc");
    EXPECT_EQ(paths().mapped_option("+RF/home/u/job/cache"), "+RFcache");
    EXPECT_EQ(paths().mapped_option("+W320 +L/home/u/lib /home/u/job/a.pov"),
              "+W320 +L../lib a.pov");
    EXPECT_EQ(paths().mapped_option("Library_Path=/home/u/lib"), "Library_Path=../lib");
    EXPECT_EQ(paths().mapped_option("library_path=\"/home/u/my lib\""),
              "library_path=\"../my lib\"");
}

TEST(PackedPaths, EverythingElseStays) {
    for (const char* option :
         {"scene.pov", "+Isub/a.pov", "+L../lib", "+W320", "+A0.3", "-D", "Declare=x=1/2", "",
          "+O/tmp/a.png", "Output_File_Name=/tmp/a.png", "+GI/tmp/a.ini", "Declare=s=\"/a\"",
          "+L/usr/share/povray-3.7/include", "Library_Path=\"/usr/share/povray-3.7\""})
        EXPECT_EQ(paths().mapped_option(option), option);
}

TEST(PackedPaths, IniFilesLineByLine) {
    const std::string ini =
        "; /home/u/lib\n"
        "  Library_Path = /home/u/my lib  ; comment\r\n"
        "Input_File_Name=scene.pov\n"
        "[Large]\n"
        "+W640 +L/home/u/lib\n"
        "Output_File_Name=/tmp/x\n"
        "/home/u/job/more.ini";
    EXPECT_EQ(paths().mapped_ini(ini),
              "; /home/u/lib\n"
              "  Library_Path = ../my lib  ; comment\r\n"
              "Input_File_Name=scene.pov\n"
              "[Large]\n"
              "+W640 +L../lib\n"
              "Output_File_Name=/tmp/x\n"
              "more.ini");
    EXPECT_EQ(paths().mapped_ini(""), "");
    EXPECT_EQ(paths().mapped_ini("\n\nWidth=3\n"), "\n\nWidth=3\n");
}

}  // namespace
}  // namespace mpipov
