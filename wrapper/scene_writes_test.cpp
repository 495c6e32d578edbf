#include "scene_writes.h"

#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

std::string text_of(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(SceneWrites, AreFoundInTheText) {
    const SceneWrites writes = writes_in(
        "#fopen A \"a.txt\" write\n# fopen B\n \"b.txt\"\tappend #fopen C \"c.txt\" read\n");
    EXPECT_TRUE(writes.any);
    EXPECT_THAT(writes.names, ElementsAre("a.txt", "b.txt"));
}

TEST(SceneWrites, MayHaveAComputedName) {
    const SceneWrites writes = writes_in("#fopen A concat(\"a\", \".txt\") write\n");
    EXPECT_TRUE(writes.any);
    EXPECT_TRUE(writes.computed);
    EXPECT_THAT(writes.names, IsEmpty());
    EXPECT_FALSE(writes_in("#fopen A \"a.txt\" write\n").computed);
}

TEST(SceneWrites, AreNotWhatIsReadOrCalledSo) {
    EXPECT_FALSE(writes_in("#fopen A \"a.txt\" read\n#write (A, 1)\n").any);
    EXPECT_FALSE(writes_in("// write\n#declare write_it = 1; #if (1) #end\n").any);
    EXPECT_FALSE(writes_in("#fopen A \"a.txt\" read #declare append = 1;").any);
    EXPECT_FALSE(writes_in("#fopen").any);
    EXPECT_FALSE(writes_in("#").any);
}

TEST(SceneWrites, OfASceneAreThoseOfItsIncludesToo) {
    const ScratchFolder folder("writes-test");
    std::ofstream(folder.path() / "scene.pov") << "#include \"log.inc\"\n";
    const std::vector<std::string> arguments{(folder.path() / "scene.pov").string()};
    std::ofstream(folder.path() / "log.inc") << "sphere { 0, 1 }\n";
    EXPECT_FALSE(writes_of_scene(arguments, {}).any);
    std::ofstream(folder.path() / "log.inc") << "#fopen A \"log.txt\" append\n";
    EXPECT_TRUE(writes_of_scene(arguments, {}).any);
}

TEST(WritableView, ShowsWhatIsThereAndKeepsWhatIsWritten) {
    const ScratchFolder folder("writes-test");
    const fs::path original = folder.path() / "original";
    fs::create_directories(original / "parts");
    std::ofstream(original / "parts/a.inc") << "a";
    std::ofstream(original / "scene.pov") << "scene";
    std::ofstream(original / "log.txt") << "old";
    fs::create_directories(folder.path() / "library");
    std::ofstream(folder.path() / "library/b.inc") << "b";
    const fs::path view = make_writable_view(folder.path() / "view", original,
                                             {true, {"log.txt", "new.txt"}, false}, {original});
    EXPECT_EQ(text_of(view / "../library/b.inc"), "b") << "as +L../library finds it";
    EXPECT_EQ(text_of(view / "scene.pov"), "scene");
    EXPECT_EQ(text_of(view / "parts/a.inc"), "a");
    EXPECT_EQ(text_of(view / "parts/../scene.pov"), "scene");
    EXPECT_EQ(text_of(view / "log.txt"), "old");
    std::ofstream(view / "log.txt", std::ios::app) << " and new";
    std::ofstream(view / "new.txt") << "new";
    EXPECT_EQ(text_of(view / "log.txt"), "old and new");
    EXPECT_EQ(text_of(original / "log.txt"), "old");
    EXPECT_FALSE(fs::exists(original / "new.txt"));
    fs::remove_all(folder.path() / "view");
    EXPECT_EQ(text_of(folder.path() / "library/b.inc"), "b");
    EXPECT_EQ(text_of(original / "parts/a.inc"), "a");
}

TEST(WritableView, HasCopiesOfSmallFilesWhereANameIsComputed) {
    const ScratchFolder folder("writes-test");
    const fs::path original = folder.path() / "original";
    fs::create_directories(original);
    std::ofstream(original / "log.txt") << "old";
    std::ofstream(original / "large.txt") << "x";
    fs::resize_file(original / "large.txt", 2 << 20);
    const fs::path view =
        make_writable_view(folder.path() / "view", original, {true, {}, true}, {original});
    std::ofstream(view / "log.txt", std::ios::app) << " and new";
    EXPECT_EQ(text_of(view / "log.txt"), "old and new");
    EXPECT_EQ(text_of(original / "log.txt"), "old");
    EXPECT_TRUE(fs::is_symlink(view / "large.txt"));
}

TEST(WritableView, HasNoCopyOfWhatMayNotBeRead) {
    const ScratchFolder folder("writes-test");
    const fs::path home = folder.path() / "home";
    fs::create_directories(home);
    std::ofstream(home / "passwords.txt") << "secret";
    std::ofstream(home / "scene.pov") << "scene";
    for (const bool computed : {false, true}) {
        const fs::path view = make_writable_view(folder.path() / (computed ? "a" : "b"), home,
                                                 {true, {"passwords.txt", "scene.pov"}, computed},
                                                 {home / "scene.pov"});
        EXPECT_TRUE(fs::is_symlink(view / "passwords.txt"));
        EXPECT_FALSE(fs::is_symlink(view / "scene.pov"));
    }
}

}  // namespace
}  // namespace mpipov
