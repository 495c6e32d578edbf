#include "part_file.h"

#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <future>
#include <iterator>
#include <stdexcept>
#include <string>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class PartFileTest : public testing::Test {
  protected:
    const fs::path& folder() const { return scratch_.path(); }

    static std::string read(const fs::path& file) {
        std::ifstream in(file);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    // How many entries the folder has: a part that was forgotten is one.
    auto entries() const { return std::distance(fs::directory_iterator(folder()), {}); }

  private:
    ScratchFolder scratch_{"part-file-test"};
};

TEST_F(PartFileTest, ReplacesAFile) {
    write_whole(folder() / "a", "old");
    write_whole(folder() / "a", "new");
    EXPECT_EQ(read(folder() / "a"), "new");
    EXPECT_EQ(entries(), 1);
}

TEST_F(PartFileTest, WhatTakesNoPlaceIsRemoved) {
    { const PartFile part(folder() / "a"); }
    EXPECT_EQ(entries(), 0);
}

TEST_F(PartFileTest, FollowsALink) {
    fs::create_directory(folder() / "far");
    fs::create_symlink("far/a", folder() / "first");
    fs::create_symlink("first", folder() / "second");
    write_whole(folder() / "second", "made");  // what the link names was not there
    write_whole(folder() / "second", "replaced");
    EXPECT_TRUE(fs::is_symlink(folder() / "first"));
    EXPECT_TRUE(fs::is_symlink(folder() / "second"));
    EXPECT_EQ(read(folder() / "far" / "a"), "replaced");
}

TEST_F(PartFileTest, LinksInACircleAreRefused) {
    fs::create_symlink("b", folder() / "a");
    fs::create_symlink("a", folder() / "b");
    EXPECT_THROW(PartFile(folder() / "a"), std::runtime_error);
}

// A pipe of the test's own stands for the devices: to replace one of those would harm the machine.
TEST_F(PartFileTest, WritesIntoAPipe) {
    const fs::path pipe = folder() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const std::string text(200'000, 'x');  // more than a pipe holds
    std::future<std::string> reader = std::async(std::launch::async, read, pipe);
    write_whole(pipe, text);
    EXPECT_EQ(reader.get(), text);
    EXPECT_TRUE(fs::is_fifo(pipe));
    EXPECT_EQ(entries(), 1);
}

// As bash's >(gzip > file) has it: a link to what has no name.
TEST_F(PartFileTest, WritesIntoAPipeWithoutAName) {
    int ends[2] = {-1, -1};
    ASSERT_EQ(::pipe(ends), 0);
    write_whole("/proc/self/fd/" + std::to_string(ends[1]), "text");
    ::close(ends[1]);
    std::string text(10, ' ');
    text.resize(static_cast<std::size_t>(::read(ends[0], text.data(), text.size())));
    ::close(ends[0]);
    EXPECT_EQ(text, "text");
}

TEST_F(PartFileTest, AMissingFolderIsNamed) {
    try {
        const PartFile part(folder() / "missing" / "a");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr((folder() / "missing" / "a").string()));
    }
}

}  // namespace
}  // namespace mpipov
