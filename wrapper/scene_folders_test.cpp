#include "scene_folders.h"

#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

class SceneFoldersTest : public testing::Test {
  protected:
    SceneFoldersTest() {
        for (const char* file : {"home/scene.pov", "home/ball.inc", "home/IMAGE.PNG",
                                 "home/passwords.txt", "home/.ssh/id", "home/work/scene.pov",
                                 "home/work/parts/a.inc", "home/conf/job.ini", "home/lib/x.inc"}) {
            fs::create_directories(at(file).parent_path());
            std::ofstream(at(file)) << "x";
        }
    }

    fs::path at(const std::string& name) const { return scratch_.path() / name; }

    std::vector<fs::path> folders(const std::string& run_folder, std::vector<std::string> arguments,
                                  const std::string& settings = "") const {
        return scene_folders({std::move(arguments), at(run_folder), at("home"),
                              settings.empty() ? fs::path() : at(settings)});
    }

    ScratchFolder scratch_{"folders-test"};
};

TEST_F(SceneFoldersTest, AreTheScenesAndThatOfTheRun) {
    EXPECT_THAT(folders("home/work", {"scene.pov", "+W640"}),
                UnorderedElementsAre(at("home/work"), at("home/work/scene.pov")));
    EXPECT_THAT(
        folders("home/work/parts", {"../scene"}),
        UnorderedElementsAre(at("home/work"), at("home/work/scene.pov"), at("home/work/parts")))
        << "without its extension";
    EXPECT_THAT(folders("home/work", {"../conf/job.ini[high]", "+I\"scene.pov\""}),
                UnorderedElementsAre(at("home/conf"), at("home/conf/job.ini"), at("home/work"),
                                     at("home/work/scene.pov")));
}

TEST_F(SceneFoldersTest, AreThoseOfLibraryPaths) {
    EXPECT_THAT(folders("home/work", {"+L../lib", "Library_Path=\"../conf\"", "+Lnone"}),
                UnorderedElementsAre(at("home/lib"), at("home/conf"), at("home/work")));
    std::ofstream(at("home/povray.ini"))
        << "; Library_Path=" << at("home/conf").string()
        << "\nLibrary_Path=" << at("home/lib").string() << "\n+W320\n";
    EXPECT_THAT(folders("home/work", {}, "home/povray.ini"),
                UnorderedElementsAre(at("home/lib"), at("home/povray.ini"), at("home/work")));
}

TEST_F(SceneFoldersTest, NoIniFileOfTheScenesNamesOne) {
    std::ofstream(at("home/work/scene.ini")) << "Library_Path=" << at("home/.ssh").string() << '\n';
    EXPECT_THAT(folders("home/work", {"scene.ini"}), Not(Contains(at("home/.ssh"))));
}

TEST_F(SceneFoldersTest, ARadiosityCacheIsReadAlone) {
    std::ofstream(at("home/.ssh/cache")) << "x";
    EXPECT_THAT(folders("home/work", {"+RF\"../lib/x.inc\""}),
                UnorderedElementsAre(at("home/lib/x.inc"), at("home/work")));
    EXPECT_THAT(folders("home/work", {"+RF../.ssh/cache", "+RF../.ssh/to_be_written"}),
                UnorderedElementsAre(at("home/.ssh/cache"), at("home/work")));
}

TEST_F(SceneFoldersTest, OneRuleSaysWhatMayBeRead) {
    fs::create_symlink("../.ssh/id", at("home/work/link"));
    const std::vector<fs::path> readable = folders("home", {"work/scene.pov", "+RFlib/x.inc"});
    EXPECT_TRUE(may_be_read(at("home/work/parts/a.inc"), readable));
    EXPECT_TRUE(may_be_read(at("home/work/not_there"), readable));
    EXPECT_TRUE(may_be_read(at("home/work/../lib/x.inc"), readable));
    EXPECT_FALSE(may_be_read(at("home/lib/y.inc"), readable));
    EXPECT_FALSE(may_be_read(at("home/passwords.txt"), readable));
    EXPECT_FALSE(may_be_read(at("home/work/../.ssh/id"), readable));
    EXPECT_FALSE(may_be_read(at("home/work/link"), readable));
    EXPECT_FALSE(may_be_read(at("home/work/parts/a.inc"), {}));
}

TEST_F(SceneFoldersTest, ASceneThatIsALinkOpensItsFileAndNotThatsFolder) {
    fs::create_symlink("../lib/x.inc", at("home/work/link.pov"));
    const std::vector<fs::path> readable = folders("home/work", {"link.pov"});
    EXPECT_TRUE(may_be_read(at("home/lib/x.inc"), readable));
    EXPECT_FALSE(may_be_read(at("home/lib/y.inc"), readable));
}

TEST_F(SceneFoldersTest, OfTheHomeFolderOnlyNeighboursOfAScene) {
    fs::create_symlink(".ssh/id", at("home/key.inc"));
    EXPECT_THAT(
        folders("home", {"scene.pov"}),
        UnorderedElementsAre(at("home/scene.pov"), at("home/ball.inc"), at("home/IMAGE.PNG")));
    EXPECT_THAT(folders("home", {"work/scene.pov"}),
                ElementsAre(at("home/work"), at("home/work/scene.pov")))
        << "not the folder of the run";
    EXPECT_THAT(folders(".", {}), IsEmpty()) << "the home folder is in it";
}

TEST_F(SceneFoldersTest, AFolderMayBeForMoreThanAScene) {
    EXPECT_TRUE(is_for_more_than_a_scene("/tmp", at("home")));
    EXPECT_TRUE(is_for_more_than_a_scene("/", at("home")));
    EXPECT_TRUE(is_for_more_than_a_scene("/", {}));
    EXPECT_TRUE(is_for_more_than_a_scene(at("home"), at("home")));
    EXPECT_TRUE(is_for_more_than_a_scene(at("home/work/.."), at("home")));
    EXPECT_TRUE(is_for_more_than_a_scene(scratch_.path(), at("home")));
    EXPECT_FALSE(is_for_more_than_a_scene(at("home/work"), at("home")));
    EXPECT_FALSE(is_for_more_than_a_scene(at("home/work"), {}));
    fs::create_directory_symlink("home", at("link"));
    EXPECT_TRUE(is_for_more_than_a_scene(at("link"), at("home")));
    EXPECT_TRUE(is_for_more_than_a_scene(at("home"), at("link")));
}

TEST(LibraryPaths, AreTakenFromOptionsAndSettings) {
    EXPECT_THAT(library_paths_in("+Lparts"), ElementsAre("parts"));
    EXPECT_THAT(library_paths_in("-l\"my parts\""), Contains("my parts"));
    EXPECT_THAT(library_paths_in(" Library_Path = parts "), ElementsAre("parts"));
    EXPECT_THAT(library_paths_in("+W320 +Lparts"), ElementsAre("parts"));
    EXPECT_THAT(library_paths_in("+Iscene.pov"), IsEmpty());
    EXPECT_THAT(library_paths_in(""), IsEmpty());
    EXPECT_THAT(caches_in("Radiosity_File_Name=a.rca"), ElementsAre("a.rca"));
}

}  // namespace
}  // namespace mpipov
