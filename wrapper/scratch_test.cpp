#include "scratch.h"

#include "failure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <optional>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

// TMPDIR is another one for as long as this lives.
class OtherTemporaryFolder {
  public:
    explicit OtherTemporaryFolder(const fs::path& folder) {
        if (const char* value = std::getenv("TMPDIR")) before_ = value;
        ::setenv("TMPDIR", folder.c_str(), 1);
    }
    OtherTemporaryFolder(const OtherTemporaryFolder&) = delete;
    OtherTemporaryFolder& operator=(const OtherTemporaryFolder&) = delete;
    ~OtherTemporaryFolder() {
        if (before_)
            ::setenv("TMPDIR", before_->c_str(), 1);
        else
            ::unsetenv("TMPDIR");
    }

  private:
    std::optional<std::string> before_;
};

TEST(Scratch, IsThereAndOursAlone) {
    const ScratchFolder scratch("purpose");
    EXPECT_TRUE(fs::is_directory(scratch.path()));
    EXPECT_TRUE(fs::is_empty(scratch.path()));
    EXPECT_THAT(scratch.path().filename().string(), testing::StartsWith("mpipov-purpose."));
    const auto rights = fs::status(scratch.path()).permissions();
    EXPECT_EQ(rights & (fs::perms::group_all | fs::perms::others_all), fs::perms::none);
}

TEST(Scratch, AFolderThatPovrayCannotBeToldIsNamed) {
    const ScratchFolder scratch("quote");
    const fs::path folder = scratch.path() / "a \"quoted\" name";
    fs::create_directory(folder);
    const OtherTemporaryFolder other(folder);
    try {
        const ScratchFolder inside("inside");
        FAIL() << inside.path();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::file);
        EXPECT_THAT(failure.what(), testing::HasSubstr("TMPDIR"));
    }
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Scratch, TwoAreNeverTheSame) {
    const ScratchFolder a("same"), b("same");
    EXPECT_NE(a.path(), b.path());
}

TEST(Scratch, GoesWithAllThatIsInIt) {
    fs::path path;
    {
        const ScratchFolder scratch("test");
        path = scratch.path();
        fs::create_directories(path / "a" / "b");
        std::ofstream(path / "a" / "b" / "file") << "x";
        // What a link leads to is not ours.
        fs::create_directory_symlink(fs::temp_directory_path(), path / "link");
    }
    EXPECT_FALSE(fs::exists(path));
    EXPECT_TRUE(fs::exists(fs::temp_directory_path()));
}

TEST(Scratch, LiesBelowTmpdir) {
    const ScratchFolder outer("outer");
    const OtherTemporaryFolder other(outer.path());
    const ScratchFolder inner("inner");
    EXPECT_EQ(inner.path().parent_path(), outer.path());
}

TEST(Scratch, LiesBelowTmpWhereTmpdirIsNoFolder) {
    const OtherTemporaryFolder other("/no/such/folder");
    const ScratchFolder scratch("test");
    EXPECT_EQ(scratch.path().parent_path(), "/tmp");
}

TEST(Scratch, SaysWhereItCannotBeMade) {
    try {
        const ScratchFolder scratch("no/such");  // a purpose is a name
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::file);
        EXPECT_THAT(failure.what(), testing::HasSubstr(fs::temp_directory_path().string()));
    }
}

}  // namespace
}  // namespace mpipov
