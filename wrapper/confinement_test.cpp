#include "confinement.h"

#include "failure.h"
#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Optional;
using testing::Pair;

constexpr std::uint64_t mib = std::uint64_t{1} << 20, gib = mib << 10;

std::string not_found(const std::string& name) {
    return "Possible Parse Error: Cannot find file '" + name +
           "', even after trying to append file type extension.\n"
           "Parse Error: Cannot open include file x.\n";
}

std::string not_written(const std::string& name) {
    return "File 'a.pov' line 1: Parse Error: Cannot open user file " + name + " (write).\n";
}

class ConfinementTest : public testing::Test {
  protected:
    ConfinementTest() {
        for (const char* folder : {"home", "work", "other", "own", "launch"})
            fs::create_directory(at(folder));
        std::ofstream(at("work/scene.pov")) << "sphere { 0, 1 }\n";
        std::ofstream(at("other/tile.png")) << "x";
        ::setenv("HOME", at("home").c_str(), 1);
        ::unsetenv("POVINI");
        fs::current_path(at("work"));
        options_.povray_arguments = {"scene.pov"};
    }
    ~ConfinementTest() override {
        fs::current_path(before_);
        if (home_.empty())
            ::unsetenv("HOME");
        else
            ::setenv("HOME", home_.c_str(), 1);
    }

    fs::path at(const std::string& name) const { return scratch_.path() / name; }
    Confinement confinement() const { return {options_, {8 * gib, 4}, at("own")}; }
    LaunchNeeds needs() const { return {{"povray", "scene.pov"}, at("launch")}; }

    std::string home_ = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "";
    fs::path before_ = fs::current_path();
    ScratchFolder scratch_{"confinement-test"};
    Options options_;
};

TEST_F(ConfinementTest, GivesPovrayAHomeOfTheRuns) {
    const ChildRequest request = confinement().request(needs());
    EXPECT_THAT(request.environment, Contains(Pair("HOME", at("own/home").string())));
    EXPECT_THAT(request.environment, Contains(Pair("POV_TEMP_DIR", at("launch").string())));
    EXPECT_TRUE(fs::exists(at("own/home/.povray/3.7/povray.conf")));
    EXPECT_THAT(request.argv, ElementsAre(EndsWith("povray"), "scene.pov"));
    EXPECT_TRUE(request.working_directory.empty());
    EXPECT_EQ(confinement().note().empty(), can_restrict_files());
}

TEST_F(ConfinementTest, KeepsTheUsersOwnSettings) {
    fs::create_directories(at("home/.povray/3.7"));
    const fs::path settings = at("home/.povray/3.7/povray.ini");
    std::ofstream(settings) << "Library_Path=" << at("other").string() << '\n';
    const Confinement own = confinement();
    EXPECT_THAT(own.request(needs()).environment, Contains(Pair("POVINI", settings.string())));
    EXPECT_THAT(own.way_out(not_found(at("other/tile.png").string())), IsEmpty())
        << "it may be read, so that is not the cause";
    std::ofstream(at("work/povray.ini")) << "+W320\n";
    for (const auto& [name, value] : confinement().request(needs()).environment)
        EXPECT_NE(name, "POVINI") << "POV-Ray takes that of the folder of the run";
}

TEST_F(ConfinementTest, AllowsWhatWasNamedAndTheLaunchsFolder) {
    if (!can_restrict_files()) GTEST_SKIP() << "this kernel has no Landlock";
    options_.allow_read = {"../other"};
    options_.allow_write = {at("home")};
    LaunchNeeds needs = this->needs();
    needs.reads = {at("own/cache")};
    const FileAccess files = confinement().request(needs).files.value();
    EXPECT_THAT(files.read, Contains(at("work")));
    EXPECT_THAT(files.read, Contains(at("own/cache")));
    EXPECT_THAT(files.read, Contains(at("other")));
    EXPECT_THAT(files.write, Contains(at("launch")));
    EXPECT_THAT(files.write, Contains(at("home")));
}

TEST_F(ConfinementTest, SaysWhatMayBeAllowed) {
    if (!can_restrict_files()) GTEST_SKIP() << "this kernel has no Landlock";
    const Confinement it = confinement();
    EXPECT_THAT(it.way_out(not_found("../other/tile.png")),
                HasSubstr("--allow-read '" + at("other").string() + "'"));
    EXPECT_THAT(it.way_out(not_found("../other/tile")),
                AllOf(HasSubstr("tile.png"), HasSubstr("--allow-read '" + at("other").string())))
        << "POV-Ray appends an extension";
    EXPECT_THAT(it.way_out(not_found("../other/none.png")), IsEmpty());
    EXPECT_THAT(it.way_out(not_found("none.png")), IsEmpty());
    EXPECT_THAT(it.way_out(not_written("../other/a.txt")),
                HasSubstr("--allow-write '" + at("other").string() + "'"));
    EXPECT_THAT(it.way_out("Parse Error: std::bad_alloc"), HasSubstr("--memory-limit"));
    EXPECT_THAT(Confinement().way_out("Parse Error: std::bad_alloc"), IsEmpty());
}

// A scene chooses the name; what it then has from the user is his own doing.
TEST_F(ConfinementTest, ProposesNoFolderThatASceneMustNotHave) {
    if (!can_restrict_files()) GTEST_SKIP() << "this kernel has no Landlock";
    fs::create_directory(at("home/.ssh"));
    for (const char* file : {"home/a.inc", "home/.ssh/a.inc", "other/notes.txt"})
        std::ofstream(at(file)) << "x";
    const Confinement it = confinement();
    for (const std::string& name : {at("home/a.inc").string(), at("home/.ssh/a.inc").string(),
                                    std::string("/etc/passwd"), at("other/notes.txt").string()}) {
        EXPECT_THAT(it.way_out(not_found(name)),
                    AllOf(HasSubstr("'" + name + "' may not be read"), HasSubstr("--allow-read"),
                          Not(HasSubstr("--allow-read '"))));
        EXPECT_THAT(
            it.way_out("File 'a.pov' line 1: Parse Error: Parse halted by #error directive: " +
                       not_found(name)),
            IsEmpty());
    }
    EXPECT_THAT(it.way_out(not_written(at("home/a.txt").string())),
                AllOf(HasSubstr("may not be written"), Not(HasSubstr("--allow-write '"))));
}

TEST_F(ConfinementTest, PovrayIsTheOneThatWasFoundFirst) {
    std::ofstream(at("other/povray-here")) << "#!/bin/sh\n";
    fs::permissions(at("other/povray-here"), fs::perms::owner_all);
    const std::string before = std::getenv("PATH");
    ::setenv("PATH", (":" + at("other").string()).c_str(), 1);
    options_.povray = "povray-here";
    LaunchNeeds needs = this->needs();
    needs.argv.front() = "povray-here";
    EXPECT_EQ(confinement().request(needs).argv.front(), at("other/povray-here"));
    ::setenv("PATH", before.c_str(), 1);
}

TEST_F(ConfinementTest, WhatIsToBeAllowedMustBeThere) {
    if (!can_restrict_files()) GTEST_SKIP() << "this kernel has no Landlock";
    options_.allow_read = {"../none"};
    EXPECT_THAT([&] { confinement(); },
                testing::ThrowsMessage<Failure>(HasSubstr("--allow-read '../none'")));
}

TEST_F(ConfinementTest, OffLeavesFilesAndLimitsTheRest) {
    options_.confine = Confining::off;
    const Confinement it = confinement();
    EXPECT_FALSE(it.restricts_files());
    EXPECT_FALSE(it.request(needs()).files);
    EXPECT_TRUE(it.request(needs()).memory_limit_bytes);
    EXPECT_FALSE(Confinement().request(needs()).memory_limit_bytes);
}

TEST_F(ConfinementTest, SharesTheMemoryByThreads) {
    const auto limit = [&](int threads) {
        LaunchNeeds needs = this->needs();
        needs.threads = threads;
        return confinement().request(needs).memory_limit_bytes.value_or(0) / mib;
    };
    EXPECT_EQ(limit(1), 1638U) << "80 % of 8 GiB for 4 cores";
    EXPECT_EQ(limit(4), 6553U);
    EXPECT_EQ(limit(9), 6553U) << "there is no more";
    const Confinement small(options_, {gib, 16}, at("own"));
    EXPECT_EQ(small.request(needs()).memory_limit_bytes, gib) << "POV-Ray needs some";
    options_.memory_limit = {false, 300 * mib};
    EXPECT_EQ(limit(4), 300U);
    options_.memory_limit = {false, {}};
    EXPECT_EQ(limit(4), 0U);
}

TEST_F(ConfinementTest, LimitsWhatALaunchWrites) {
    const std::uint64_t half = fs::space(at("launch")).available / 2;
    LaunchNeeds needs = this->needs();
    EXPECT_LE(confinement().request(needs).folder_limit.value().bytes, gib);
    EXPECT_EQ(confinement().request(needs).file_size_limit_bytes, gib);
    needs.pixels = std::uint64_t{60000} * 40000;
    EXPECT_GT(confinement().request(needs).file_size_limit_bytes.value_or(0), *needs.pixels * 20)
        << "the file with holes, whatever is free";
    needs.pixels.reset();
    const std::uint64_t most = confinement().request(needs).folder_limit.value().bytes;
    EXPECT_FALSE(confinement().request(needs).file_size_limit_bytes);
    EXPECT_GT(most, half / 2);
    EXPECT_LT(most, half * 2);
    options_.disk_limit = {false, 5 * mib};
    const ChildRequest request = confinement().request(needs);
    EXPECT_EQ(request.folder_limit.value().bytes, 5 * mib);
    EXPECT_EQ(request.folder_limit.value().folder, at("launch"));
    EXPECT_EQ(request.file_size_limit_bytes, 5 * mib);
}

TEST_F(ConfinementTest, OfASceneThatWasSentHereOnlyTheCopyIsRead) {
    fs::create_directories(at("copy/job"));
    std::ofstream(at("copy/job/scene.pov")) << "sphere { 0, 1 }\n";
    const ChildRequest request =
        confinement()
            .in_copy({at("copy"), at("copy/job"), at("copy/povray.ini"), {"scene.pov"}})
            .request(needs());
    EXPECT_EQ(request.working_directory, at("copy/job"));
    EXPECT_THAT(request.environment, Contains(Pair("POVINI", at("copy/povray.ini").string())));
    if (!can_restrict_files()) GTEST_SKIP() << "this kernel has no Landlock";
    EXPECT_THAT(request.files.value().read, Contains(at("copy")));
    EXPECT_THAT(request.files.value().read, Not(Contains(at("work"))));
    std::ofstream(at("copy/job/scene.pov")) << "#fopen F \"a.txt\" write\n";
    EXPECT_EQ(confinement()
                  .in_copy({at("copy"), at("copy/job"), {}, {"scene.pov"}})
                  .request(needs())
                  .working_directory,
              at("launch/view") / fs::canonical(at("copy/job")).relative_path());
}

TEST_F(ConfinementTest, ASceneThatWritesRunsInAFolderOfItsLaunch) {
    if (!can_restrict_files()) GTEST_SKIP() << "this kernel has no Landlock";
    std::ofstream(at("work/scene.pov")) << "#fopen F \"a.txt\" write\n";
    const ChildRequest request = confinement().request(needs());
    EXPECT_EQ(request.working_directory,
              at("launch/view") / fs::canonical(at("work")).relative_path());
    EXPECT_THAT(confinement().note(), HasSubstr("--allow-write"));
    EXPECT_TRUE(fs::exists(request.working_directory / "scene.pov"));
    options_.allow_write = {"."};
    EXPECT_TRUE(confinement().request(needs()).working_directory.empty())
        << "it may write into the folder of the run";
}

}  // namespace
}  // namespace mpipov
