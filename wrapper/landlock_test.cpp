#include "landlock.h"

#include "child_process.h"
#include "program_files.h"
#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Optional;

class LandlockTest : public testing::Test {
  protected:
    void SetUp() override {
        if (!can_restrict_files()) GTEST_SKIP() << "this kernel has no Landlock";
        for (const char* folder : {"mine", "theirs"}) {
            fs::create_directory(scratch_.path() / folder);
            std::ofstream(scratch_.path() / folder / "text") << folder << "'s text";
        }
    }

    // A shell that may read and run what every program may, and write to `mine`.
    ChildResult run(const std::string& script) {
        ChildRequest request;
        request.argv = {"sh", "-c", script};
        request.files = files_of_program(find_program("sh"));
        for (const char* program : {"cat", "mkdir", "ln", "mv", "rm"})
            request.files->execute.push_back(find_program(program));
        request.files->write.push_back(scratch_.path() / "mine");
        resolve_links(*request.files);
        request.working_directory = scratch_.path();
        return run_to_end(request, &output_);
    }

    ScratchFolder scratch_{"landlock-test"};
    std::string output_;
};

TEST_F(LandlockTest, WhatIsAllowedWorks) {
    EXPECT_THAT(run("cat mine/text && echo new > mine/text && mkdir mine/a && echo b > mine/a/b && "
                    "mv mine/a/b mine/a/c && rm mine/a/c && cat mine/text 2> /dev/null")
                    .exit_code,
                Optional(0))
        << output_;
    EXPECT_EQ(output_, "mine's textnew\n");
}

TEST_F(LandlockTest, NothingElseIsReadOrListed) {
    for (const char* way :
         {"cat theirs/text", "cat mine/../theirs/text", "cat mine/link", "cat mine/folder/text",
          "cat /proc/self/environ", "cat /etc/passwd", "cat < theirs/text"}) {
        std::error_code ignored;
        fs::create_symlink("../theirs/text", scratch_.path() / "mine/link", ignored);
        fs::create_symlink(scratch_.path() / "theirs", scratch_.path() / "mine/folder", ignored);
        EXPECT_NE(run(way).exit_code, 0) << way;
        EXPECT_THAT(output_, HasSubstr("denied")) << way;
    }
    EXPECT_THAT(run("echo theirs/*").exit_code, Optional(0));
    EXPECT_EQ(output_, "theirs/*\n");
}

TEST_F(LandlockTest, NothingElseIsWrittenMadeOrRemoved) {
    for (const char* way :
         {"echo a > theirs/text", "echo a > theirs/new", "mkdir theirs/new", "rm theirs/text",
          "mv theirs/text mine/text", "mv mine/text theirs/new", "ln -s text mine/new",
          "ln theirs/text mine/new", "echo a > new", "mkdir /tmp/mpipov-landlock-test-new"})
        EXPECT_NE(run(way).exit_code, 0) << way;
    EXPECT_TRUE(fs::exists(scratch_.path() / "theirs/text"));
    EXPECT_FALSE(fs::exists(scratch_.path() / "theirs/new"));
}

TEST_F(LandlockTest, NothingElseIsStarted) {
    EXPECT_THAT(run("ls").exit_code, Optional(126)) << output_;
    EXPECT_THAT(run("cp mine/text mine/new").exit_code, Optional(126)) << output_;
}

TEST_F(LandlockTest, ALinkThatTakesThePlaceOfWhatIsAllowedLeadsNowhere) {
    ChildRequest request;
    request.argv = {"cat", "theirs/text"};
    request.files = files_of_program(find_program("cat"));
    resolve_links(*request.files);
    request.files->read.push_back(scratch_.path() / "mine/text");
    request.working_directory = scratch_.path();
    fs::remove(scratch_.path() / "mine/text");
    fs::create_symlink(scratch_.path() / "theirs/text", scratch_.path() / "mine/text");
    EXPECT_THAT(run_to_end(request).exit_code, Optional(1));
}

TEST_F(LandlockTest, AFileAloneCanBeAllowed) {
    ChildRequest request;
    request.argv = {"cat", "theirs/text"};
    request.files = files_of_program(find_program("cat"));
    request.files->read.push_back(scratch_.path() / "theirs/text");
    request.files->read.emplace_back("/no/such/file");
    resolve_links(*request.files);
    request.working_directory = scratch_.path();
    std::string output;
    EXPECT_THAT(run_to_end(request, &output).exit_code, Optional(0)) << output;
    EXPECT_EQ(output, "theirs's text");
    request.argv = {"cat", "mine/text"};
    EXPECT_THAT(run_to_end(request).exit_code, Optional(1));
}

}  // namespace
}  // namespace mpipov
