#include "output_bounds.h"

#include "failure.h"
#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OutputBoundsTest : public testing::Test {
  protected:
    OutputBoundsTest() {
        for (const char* folder : {"home/work/out", "home/.ssh", "home/pictures"})
            fs::create_directories(at(folder));
        fs::current_path(at("home/work"));
        options_.povray_arguments = {"scene.ini"};
    }
    ~OutputBoundsTest() override { fs::current_path(before_); }

    fs::path at(const std::string& name) const { return scratch_.path() / name; }

    std::string refused(const fs::path& image) const {
        try {
            require_within_bounds(
                {image, options_.record, options_.work_dir}, options_,
                {options_.povray_arguments, fs::current_path(), at("home"), settings_});
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), Exit::usage);
            return failure.what();
        }
        return {};
    }

    fs::path before_ = fs::current_path();
    ScratchFolder scratch_{"output-bounds-test"};
    Options options_;
    fs::path settings_;
};

TEST_F(OutputBoundsTest, WhatTheUserNamesIsWritten) {
    fs::current_path(at("home"));
    EXPECT_THAT(refused(".hidden.png"), HasSubstr("+O")) << "a scene's INI file may say so";
    options_.povray_arguments = {"work/scene.pov", "+O.hidden.png"};
    EXPECT_EQ(refused(".hidden.png"), "") << "its record and work folder lie beside it";
    fs::current_path(at("home/work"));
    options_.povray_arguments = {"scene.pov", "+O../pictures"};
    EXPECT_EQ(refused("../pictures.png"), "") << "POV-Ray adds an extension, folder or not";
    fs::create_symlink(at("home/.ssh/id.png"), at("home/work/link.png"));
    options_.povray_arguments = {"scene.pov", "+Olink.png"};
    EXPECT_THAT(refused("link.png"), HasSubstr("id.png")) << "a link is not what he named";
}

TEST_F(OutputBoundsTest, AreTheFolderOfTheRunAndWhatTheUserNames) {
    EXPECT_EQ(refused("scene.png"), "");
    EXPECT_EQ(refused("out/scene.png"), "");
    EXPECT_EQ(refused(std::string(300, 'n') + ".png"), "")
        << "whoever writes it says what is wrong";
    EXPECT_EQ(refused(at("home/work/scene.png")), "");
    const fs::path far = at("home/pictures/scene.png");
    EXPECT_THAT(refused(far), AllOf(HasSubstr(far.string()), HasSubstr("--allow-write")));
    EXPECT_THAT(refused("../.ssh/id.png"), HasSubstr("id.png"));
    EXPECT_THAT(refused("../scene.png"), HasSubstr("scene.png"));
    options_.povray_arguments = {"scene.ini", "+O../pictures/scene.png"};
    EXPECT_EQ(refused("../pictures/scene.png"), "");
    options_.povray_arguments = {"scene.ini", "Output_File_Name=\"../pictures/\""};
    EXPECT_EQ(refused("../pictures/scene.png"), "");
    options_.povray_arguments = {"../pictures/scene.ini"};
    EXPECT_EQ(refused(far), "") << "beside the INI file";
    options_.povray_arguments = {"scene.ini"};
    settings_ = at("home/povray.ini");
    std::ofstream(settings_) << "Output_File_Name=" << at("home/pictures/").string() << '\n';
    EXPECT_EQ(refused(far), "");
    settings_.clear();
    options_.allow_write = {"../pictures"};
    EXPECT_EQ(refused(far), "");
    options_.allow_write.clear();
    options_.confine = Confining::off;
    EXPECT_EQ(refused(far), "");
}

TEST_F(OutputBoundsTest, LinksLeadNowhereElse) {
    fs::create_symlink("../pictures/a.png", at("home/work/a.png"));
    fs::create_symlink("../.ssh", at("home/work/more"));
    fs::create_symlink("out/b.png", at("home/work/b.png"));
    options_.povray_arguments = {"scene.pov", "+Oa.png"};
    EXPECT_THAT(refused("a.png"), HasSubstr("pictures/a.png")) << "though nothing is there yet";
    EXPECT_THAT(refused("more/c.png"), HasSubstr("c.png"));
    EXPECT_EQ(refused("b.png"), "");
    fs::create_symlink("../.ssh/id", at("home/work/run.json"));
    EXPECT_THAT(refused("d.png"), HasSubstr(".ssh/id"));
    options_.record = "/dev/null";
    EXPECT_EQ(refused("d.png"), "");
    fs::create_symlink("../.ssh", at("home/work/d.png.mpipov"));
    EXPECT_THAT(refused("d.png"), HasSubstr(".ssh"));
}

TEST_F(OutputBoundsTest, NoWorkFolderOfTheScenesLeadsElsewhere) {
    fs::create_directory(at("home/work/a.png.mpipov"));
    std::ofstream(at("home/work/a.png.mpipov/journal.json")) << "{}";
    EXPECT_EQ(refused("a.png"), "");
    fs::create_symlink("../../.ssh/id", at("home/work/a.png.mpipov/sections.jsonl"));
    EXPECT_THAT(refused("a.png"), HasSubstr(".ssh/id"));
}

TEST_F(OutputBoundsTest, PipesAreForTheUserToName) {
    ASSERT_EQ(::mkfifo(at("home/work/run.json").c_str(), 0600), 0);
    EXPECT_THAT(refused("a.png"), HasSubstr("run.json"));
    options_.record = "run.json";
    EXPECT_EQ(refused("a.png"), "");
    ASSERT_EQ(::mkfifo(at("home/work/pipe.png").c_str(), 0600), 0);
    EXPECT_THAT(refused("pipe.png"), HasSubstr("pipe.png"));
    options_.povray_arguments = {"scene.pov", "+Opipe"};
    EXPECT_EQ(refused("pipe.png"), "");
}

TEST_F(OutputBoundsTest, DevicesAreForTheUserToName) {
    options_.record = "/dev/null";
    fs::create_symlink("/dev/null", at("home/work/a.png"));
    EXPECT_THAT(refused("a.png"), HasSubstr("a.png"));
    EXPECT_EQ(refused("b.png"), "");
    options_.record.clear();
    EXPECT_THAT(refused("/dev/null"), HasSubstr("/dev/null"));
    options_.povray_arguments = {"scene.ini", "+O/dev/null"};
    EXPECT_EQ(refused("/dev/null"), "");
    options_.povray_arguments = {"scene.ini", "+O/dev/fd/1"};
    EXPECT_EQ(refused("/dev/fd/1"), "");
}

TEST_F(OutputBoundsTest, OfTheHomeFolderItselfNothingIsHidden) {
    fs::current_path(at("home"));
    options_.record = "/dev/null";
    EXPECT_EQ(refused("scene.png"), "");
    EXPECT_THAT(refused(".profile.png"), HasSubstr(".profile.png"));
    EXPECT_THAT(refused("pictures/scene.png"), HasSubstr("scene.png"));
    options_.povray_arguments = {"scene.ini", "+Opictures/scene.png"};
    EXPECT_EQ(refused("pictures/scene.png"), "");
}

}  // namespace
}  // namespace mpipov
