#include "program_files.h"

#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <optional>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::Not;

class Variable {
  public:
    Variable(const char* name, const std::string& value) : name_(name) {
        if (const char* now = std::getenv(name)) before_ = now;
        ::setenv(name, value.c_str(), 1);
    }
    ~Variable() {
        if (before_)
            ::setenv(name_, before_->c_str(), 1);
        else
            ::unsetenv(name_);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
    std::optional<std::string> before_;
};

class ProgramFilesTest : public testing::Test {
  protected:
    ProgramFilesTest() {
        for (const char* folder :
             {"home/bin", "home/lib", "home/share/povray-3.7/include", "opt/lib"})
            fs::create_directories(at(folder));
        for (const char* file : {"home/key", "home/lib/key", "home/bin/key"})
            std::ofstream(at(file)) << "secret";
    }

    fs::path at(const std::string& name) const { return scratch_.path() / name; }

    // In place of POV-Ray: a program that is linked to libraries.
    fs::path program(const std::string& name) const {
        fs::copy_file(fs::canonical("/proc/self/exe"), at(name));
        return at(name);
    }
    fs::path script(const std::string& name) const {
        std::ofstream(at(name)) << "#!/bin/sh\n";
        fs::permissions(at(name), fs::perms::owner_all);
        return at(name);
    }

    ScratchFolder scratch_{"program-files-test"};
};

TEST_F(ProgramFilesTest, OfAProgramInAHomeFolderOpensPovraysOwnAlone) {
    const FileAccess files = files_of_program(program("home/bin/povray"), at("home"));
    EXPECT_THAT(files.execute, Contains(at("home/bin/povray")));
    EXPECT_THAT(files.read, Contains(at("home/share/povray-3.7")));
    for (const auto& paths : {files.read, files.execute})
        for (const char* folder : {"home", "home/lib", "home/lib64", "home/bin", "home/share"})
            EXPECT_THAT(paths, Not(Contains(at(folder))));
}

TEST_F(ProgramFilesTest, OpensTheLibrariesThatTheLoaderFinds) {
    fs::path library;
    for (const char* place : {"/lib/x86_64-linux-gnu/libz.so.1", "/usr/lib64/libz.so.1",
                              "/lib/aarch64-linux-gnu/libz.so.1"})
        if (fs::exists(place)) library = place;
    if (library.empty()) GTEST_SKIP() << "no libz.so.1 where it is looked for";
    fs::copy_file(library, at("opt/lib/libz.so.1"));
    std::ofstream(at("opt/lib/notes")) << "x";
    const Variable path("LD_LIBRARY_PATH", at("opt/lib").string());
    const FileAccess files = files_of_program(program("home/bin/povray"), at("home"));
    EXPECT_THAT(files.read, Contains(at("opt/lib/libz.so.1")));
    EXPECT_THAT(files.read, Not(Contains(at("opt/lib"))));
}

TEST_F(ProgramFilesTest, AnEmptyPartOfTheLibraryPathIsNoFolder) {
    const Variable path("LD_LIBRARY_PATH", ":" + at("opt/lib").string() + "::lib:");
    EXPECT_EQ(library_path_for_scenes(),
              at("opt/lib").string() + ":" + (fs::current_path() / "lib").string());
    const FileAccess files = files_of_program(script("home/bin/povray"), at("home"));
    EXPECT_THAT(files.read, Contains(at("opt/lib")));
    for (const fs::path& folder :
         {fs::path(), fs::path("."), fs::current_path(), fs::current_path() / ""})
        EXPECT_THAT(files.read, Not(Contains(folder)));
}

TEST_F(ProgramFilesTest, OfALibraryFolderInTheHomeFolderScriptsGetLibraries) {
    std::ofstream(at("home/lib/libown.so.1")) << "x";
    const Variable path("LD_LIBRARY_PATH", at("home/lib").string());
    const FileAccess files = files_of_program(script("home/bin/povray"), at("home"));
    EXPECT_THAT(files.read, Contains(at("home/lib/libown.so.1")));
    EXPECT_THAT(files.read, Not(Contains(at("home/lib"))));
    EXPECT_THAT(files.read, Not(Contains(at("home/lib/key"))));
}

TEST_F(ProgramFilesTest, OfAScriptsFolderOnlyProgramsAreOpened) {
    script("home/bin/beside");
    script("home/beside");
    const FileAccess files = files_of_program(script("home/bin/povray"), at("home"));
    EXPECT_THAT(files.execute, Contains(at("home/bin/beside")));
    EXPECT_THAT(files.execute, Not(Contains(at("home/bin"))));
    EXPECT_THAT(files.execute, Not(Contains(at("home/bin/key"))));
    const FileAccess of_home = files_of_program(script("home/povray"), at("home"));
    EXPECT_THAT(of_home.execute, Contains(at("home/povray")));
    for (const char* file : {"home", "home/key", "home/beside"})
        EXPECT_THAT(of_home.execute, Not(Contains(at(file))));
}

}  // namespace
}  // namespace mpipov
