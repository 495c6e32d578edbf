#include "scene_files.h"

#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(SceneFiles, NamesAreStringLiterals) {
    EXPECT_THAT(names_in_scene("#include \"a.inc\"\nimage_map{png \"b c\"}\n#debug \"\""),
                ElementsAre("a.inc", "b c"));
    EXPECT_THAT(names_in_scene(""), IsEmpty());
}

TEST(SceneFiles, CommentsAreSkipped) {
    EXPECT_THAT(names_in_scene("// \"a\"\n\"b\" // \"c\"\n\"d\"//"), ElementsAre("b", "d"));
    EXPECT_THAT(names_in_scene("/* \"a\" /* nested */ \"b\" */ \"c\" /* \"d\""), ElementsAre("c"));
    EXPECT_THAT(names_in_scene("x = 1 / 2; \"a\" */ \"b\" / *\"c\""), ElementsAre("a", "b", "c"));
}

TEST(SceneFiles, CommentMarksInStringsAreNone) {
    EXPECT_THAT(names_in_scene(R"("a//b" "c/*d" "e")"), ElementsAre("a//b", "c/*d", "e"));
}

TEST(SceneFiles, BackslashesAreTheNamesOwn) {
    EXPECT_THAT(names_in_scene(R"("sub\a.inc" "say \"b\"")"),
                ElementsAre("sub\\a.inc", "say \"b\""));
}

TEST(SceneFiles, AStrayMarkSpoilsNoMoreThanItsLine) {
    EXPECT_THAT(names_in_scene("it is 5\" long\n#include \"a.inc\"\n\""), ElementsAre("a.inc"));
}

TEST(SceneFiles, WhatTheSceneWritesIsNoPartOfIt) {
    EXPECT_THAT(names_in_scene("#fopen A \"a\" write #fopen B \"b\" read\n#fopen C \"c\"\nappend "
                               "#fopen D \"d\" writer"),
                ElementsAre("b", "d"));
}

TEST(SceneFiles, OptionsNameWhatIsRead) {
    EXPECT_THAT(names_in_option("scene.ini"), ElementsAre("scene.ini"));
    EXPECT_THAT(names_in_option("scene.ini[Large]"), ElementsAre("scene.ini"));
    EXPECT_THAT(names_in_option("+Ia.pov"), ElementsAre("a.pov"));
    EXPECT_THAT(names_in_option("+hi\"my header.inc\""),
                ElementsAre("my header.inc", "\"my", "header.inc\""));
    EXPECT_THAT(names_in_option("Include_Header = \"b.inc\""), testing::Contains("b.inc"));
    EXPECT_THAT(names_in_option("input_file_name=c.pov"), ElementsAre("c.pov"));
    EXPECT_THAT(names_in_option("+W320 a.ini +Ib.pov"), ElementsAre("a.ini", "b.pov"));
}

TEST(SceneFiles, OptionsOfAnotherKindNameNone) {
    for (const char* option : {"+Oa.png", "+GIa.ini", "+La", "-H", "+", "", " ", "Width=5",
                               "Output_File_Name=a.png", "Declare=a=b", "[Section]"})
        EXPECT_THAT(names_in_option(option), IsEmpty()) << option;
}

class SceneFilesTest : public testing::Test {
  protected:
    void SetUp() override { fs::current_path(scratch_.path()); }
    void TearDown() override { fs::current_path(before_); }

    static void write(const fs::path& file, const std::string& text) {
        if (file.has_parent_path()) fs::create_directories(file.parent_path());
        std::ofstream(file) << text;
    }
    static std::vector<std::string> files(const SceneRequest& request) {
        std::vector<std::string> names;
        for (const fs::path& file : scene_files(request)) names.push_back(file.string());
        return names;
    }

  private:
    const fs::path before_ = fs::current_path();
    const ScratchFolder scratch_{"scene-files-test"};
};

// POV-Ray cannot open them; their names in JSON would be no text either.
TEST_F(SceneFilesTest, NamesThatAreNotAsciiDoNotCount) {
    write("a.pov", "#include \"caf\xe9.inc\"\n#include \"sch\xc3\xb6n.inc\"\n#include \"b.inc\"");
    for (const char* file : {"caf\xe9.inc", "sch\xc3\xb6n.inc", "l\xe9/b.inc"}) write(file, "");
    EXPECT_THAT(files({"a.pov", {}, {"l\xe9"}, {}}), ElementsAre("a.pov"));
}

TEST_F(SceneFilesTest, FollowsIncludes) {
    write("a.pov", "#include \"b.inc\" #include \"missing.inc\"");
    write("b.inc", "#declare T = texture { pigment { image_map { png \"c\" } } }\n");
    write("c.png", "no picture \"d.inc\"");
    write("d.inc", "");
    write("unused.inc", "");
    EXPECT_THAT(files({"a.pov", {}, {}, {}}), ElementsAre("a.pov", "b.inc", "c.png", "d.inc"));
    EXPECT_THAT(files({"a", {}, {}, {}}), ElementsAre("a.pov", "b.inc", "c.png", "d.inc"));
}

TEST_F(SceneFilesTest, CyclesEnd) {
    write("a.pov", "#include \"b.inc\" #include \"./b.inc\"");
    write("b.inc", "#include \"a.pov\" #include \"b.inc\"");
    EXPECT_THAT(files({"a.pov", {}, {}, {}}), ElementsAre("a.pov", "b.inc"));
}

// One that hides another must not come or go unseen.
TEST_F(SceneFilesTest, LooksInTheFolderOfTheRunBesideTheSceneAndInLibraryPaths) {
    write("lib/sub/a.pov", "#include \"b.inc\"");
    for (const char* folder : {".", "lib/sub", "lib", "other"})
        write(fs::path(folder) / "b.inc", "");
    EXPECT_THAT(files({"sub/a.pov", {}, {"lib", "none"}, {}}),
                ElementsAre("b.inc", "lib/b.inc", "lib/sub/a.pov", "lib/sub/b.inc"));
}

TEST_F(SceneFilesTest, IniFilesNameOthers) {
    write("a.ini", "; \"x.ini\"\n[Large]\nWidth=5 ; y.ini\nb.ini\n+Is.pov +W5\n");
    write("b.ini", "Include_Header=h.inc\nOutput_File_Name=o.png\n");
    write("s.pov", "");
    write("h.inc", "#include \"i.inc\"");
    for (const char* file : {"i.inc", "o.png", "x.ini", "y.ini"}) write(file, "");
    EXPECT_THAT(files({"s.pov", {"a.ini[Large]", "+Oz.png"}, {}, {}}),
                ElementsAre("a.ini", "b.ini", "h.inc", "i.inc", "s.pov"));
}

TEST_F(SceneFilesTest, TheImageAndWhatIsPovraysOwnDoNotCount) {
    write("a.pov", "\"a.png\" \"colors.inc\" \"folder\" \"/etc\" \"b.inc\"");
    write("a.png", "");
    write("share/povray-3.7/include/colors.inc", "");
    write("povray-3.7/b.inc", "");
    fs::create_directory("folder");
    EXPECT_THAT(files({"a.pov", {}, {"share/povray-3.7/include", "povray-3.7"}, "./a.png"}),
                ElementsAre("a.pov", "povray-3.7/b.inc"));
}

TEST_F(SceneFilesTest, FilesThatAreNoTextCountButNameNone) {
    write("a.pov", "\"b.ppm\"");
    write("b.ppm", std::string("P6 \0 \"c.inc\"", 12));
    write("c.inc", "");
    EXPECT_THAT(files({"a.pov", {}, {}, {}}), ElementsAre("a.pov", "b.ppm"));
}

TEST_F(SceneFilesTest, NothingIsFoundWhereThereIsNothing) {
    EXPECT_THAT(files({"none.pov", {"none.ini", ""}, {"none"}, {}}), IsEmpty());
    EXPECT_THAT(files({"", {}, {}, {}}), IsEmpty());
    write("a.pov", "\"" + std::string(5000, 'x') + "\" \"\\\" \"a\tb\"");
    EXPECT_THAT(files({"a.pov", {}, {}, {}}), ElementsAre("a.pov"));
}

TEST(NamesInOption, ManyTakeLinearTime) {
    std::string option;
    for (int i = 0; i < 200000; ++i) option += "+Ia" + std::to_string(i) + " ";
    EXPECT_EQ(names_in_option(option).size(), 200001U) << "each, and all of it with its blanks";
}

}  // namespace
}  // namespace mpipov
