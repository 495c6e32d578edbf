#include "received_scene.h"

#include "failure.h"
#include "scratch.h"
#include "sha1_digits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

PackedFile file(const std::string& name, const std::string& text) {
    OIIO::SHA1 sha(text.data(), text.size());
    return {name, text.size(), sha1_digits(sha)};
}

std::span<const std::byte> bytes(const std::string& text) {
    return std::as_bytes(std::span(text));
}

std::string text_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

class ReceivedSceneTest : public testing::Test {
  protected:
    static ScenePack pack() {
        return {{file("scene/empty", ""), file("scene/a.pov", "sphere"), file("scene/lib/none", ""),
                 file("scene/lib/b.inc", "box"), file("povray.ini", "")},
                {"scene", "scene/folder"},
                "scene",
                "povray.ini"};
    }
    fs::path folder() const { return scratch_.path() / "copy"; }

    ReceivedScene scene_;

  private:
    const ScratchFolder scratch_{"received-scene-test"};
};

TEST_F(ReceivedSceneTest, MakesTheFilesOfAnyPieces) {
    const std::string all = "spherebox";
    for (std::size_t size = 1; size <= all.size(); ++size) {
        ReceivedScene scene;
        const fs::path here = folder() += std::to_string(size);
        scene.begin(here, pack());
        for (std::size_t at = 0; at < all.size(); at += size) {
            EXPECT_FALSE(scene.complete());
            scene.take(bytes(all.substr(at, size)));
        }
        EXPECT_TRUE(scene.complete());
        EXPECT_EQ(text_of(here / "scene/a.pov"), "sphere");
        EXPECT_EQ(text_of(here / "scene/lib/b.inc"), "box");
        for (const char* empty : {"scene/empty", "scene/lib/none", "povray.ini"})
            EXPECT_TRUE(fs::is_regular_file(here / empty)) << empty;
        EXPECT_TRUE(fs::is_directory(here / "scene/folder"));
    }
}

TEST_F(ReceivedSceneTest, NothingButEmptyFilesIsCompleteAtOnce) {
    EXPECT_FALSE(scene_.complete());
    scene_.begin(folder(), {{file("povray.ini", "")}, {"scene"}, "scene", "povray.ini"});
    EXPECT_TRUE(scene_.complete());
}

TEST_F(ReceivedSceneTest, OtherBytesThanAnnouncedAreRefused) {
    scene_.begin(folder(), pack());
    EXPECT_THAT([&] { scene_.take(bytes("cube!!box")); },
                ThrowsMessage<std::runtime_error>(HasSubstr("'scene/a.pov' changed")));
}

TEST_F(ReceivedSceneTest, LessThanAnnouncedIsNeverComplete) {
    const std::string all = "spherebox";
    for (std::size_t size = 0; size < all.size(); ++size) {
        ReceivedScene scene;
        scene.begin(folder() += std::to_string(size), pack());
        scene.take(bytes(all.substr(0, size)));
        EXPECT_FALSE(scene.complete()) << size;
        // Nor does another pack take its place.
        EXPECT_THROW(scene.begin(folder() += std::to_string(size), pack()), Failure);
    }
}

TEST_F(ReceivedSceneTest, AnotherSizeThanThatOfTheBytesIsRefused) {
    for (const int more : {-1, 1}) {
        ScenePack other = pack();
        other.files[1].bytes = static_cast<std::uint64_t>(6 + more);
        ReceivedScene scene;
        scene.begin(folder() += std::to_string(more), other);
        EXPECT_THROW(scene.take(bytes("spherebox")), std::runtime_error) << more;
    }
}

TEST_F(ReceivedSceneTest, NamesThatTheFileSystemCannotHoldAreAFailure) {
    ScenePack odd = pack();
    odd.files[0].name = "scene/" + std::string(300, 'a');
    EXPECT_THROW(scene_.begin(folder(), odd), Failure);
}

TEST_F(ReceivedSceneTest, NamesThatAreNoUtf8AreMade) {
    ScenePack odd = pack();
    odd.files[0].name = "scene/d\xe9r/caf\xe9";
    scene_.begin(folder(), odd);
    EXPECT_TRUE(fs::is_regular_file(folder() / "scene/d\xe9r/caf\xe9"));
}

// Where the file system knows no case, the second name is there already.
TEST_F(ReceivedSceneTest, AFileThatIsThereIsNotWrittenOver) {
    scene_.begin(folder(), pack());
    fs::create_directory(folder() / "scene/lib");
    std::ofstream(folder() / "scene/lib/b.inc") << "kept";
    EXPECT_THAT([&] { scene_.take(bytes("spherebox")); },
                ThrowsMessage<Failure>(HasSubstr("File exists")));
    EXPECT_EQ(text_of(folder() / "scene/lib/b.inc"), "kept");
}

TEST_F(ReceivedSceneTest, MoreThanAnnouncedIsRefused) {
    EXPECT_THROW(scene_.take(bytes("x")), std::runtime_error);
    scene_.begin(folder(), pack());
    EXPECT_THROW(scene_.take(bytes("spherebox!")), std::runtime_error);
}

TEST_F(ReceivedSceneTest, WhatCouldLeadOutIsRefusedBeforeAnythingIsMade) {
    for (const char* name : {"../escaped", "/tmp/escaped", "scene/../../escaped"}) {
        ScenePack bad = pack();
        bad.files[1].name = name;
        EXPECT_THROW(scene_.begin(folder(), bad), std::runtime_error) << name;
        EXPECT_FALSE(fs::exists(folder())) << name;
    }
}

TEST_F(ReceivedSceneTest, AFolderThatIsThereIsNotFilled) {
    fs::create_directory(folder());
    EXPECT_THROW(scene_.begin(folder(), pack()), Failure);
    fs::remove(folder());
    fs::create_directory_symlink("/tmp", folder());
    EXPECT_THROW(scene_.begin(folder(), pack()), Failure);
}

// Somebody else's link appears between two files.
TEST_F(ReceivedSceneTest, NoLinkIsWrittenThrough) {
    scene_.begin(folder(), pack());
    const fs::path target = folder().parent_path() / "target";
    std::ofstream(target) << "kept";
    fs::create_directory(folder() / "scene/lib");
    fs::create_symlink(target, folder() / "scene/lib/b.inc");
    EXPECT_THROW(scene_.take(bytes("spherebox")), Failure);
    EXPECT_EQ(text_of(target), "kept");
}

TEST_F(ReceivedSceneTest, MoreThanTheDiskHoldsIsRefusedBeforeItIsSent) {
    ScenePack large = pack();
    large.files[1].bytes = std::uint64_t{1} << 62;
    PackLimits limits;
    limits.bytes = std::uint64_t{1} << 63;
    EXPECT_THAT([&] { scene_.begin(folder(), large, limits); },
                ThrowsMessage<Failure>(HasSubstr("TMPDIR")));
    EXPECT_THAT([&] { ReceivedScene().begin(folder() += "2", large); },
                ThrowsMessage<std::runtime_error>(HasSubstr("which is the limit")));
}

}  // namespace
}  // namespace mpipov
