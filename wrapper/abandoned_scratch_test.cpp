#include "abandoned_scratch.h"

#include "scratch.h"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

class AbandonedScratch : public testing::Test {
  protected:
    fs::path made(const std::string& name) const {
        const fs::path folder = base_.path() / name;
        fs::create_directories(folder / "launch");
        std::ofstream(folder / "launch" / "section.png") << "x";
        fs::permissions(folder, fs::perms::owner_all | fs::perms::set_uid);
        return folder;
    }
    const fs::path& base() const { return base_.path(); }

  private:
    ScratchFolder base_{"test"};
};

TEST_F(AbandonedScratch, OfAKilledProcessIsRemoved) {
    const fs::path left = made("mpipov-rank12.aB3dEf");
    remove_abandoned_scratch(base(), 0);
    EXPECT_FALSE(fs::exists(left));
}

TEST_F(AbandonedScratch, ThatSomebodyHoldsStays) {
    const fs::path used = made("mpipov-probe.aB3dEf");
    std::optional<Fd> held = hold(used);
    ASSERT_GE(held->get(), 0);
    remove_abandoned_scratch(base(), 0);
    EXPECT_TRUE(fs::exists(used / "launch" / "section.png"));
    held.reset();
    remove_abandoned_scratch(base(), 0);
    EXPECT_FALSE(fs::exists(used));
}

TEST_F(AbandonedScratch, AScratchFolderIsHeld) {
    const fs::path place = base() / "place";
    fs::create_directory(place);
    ::setenv("TMPDIR", place.c_str(), 1);
    {
        const ScratchFolder scratch("rank0");
        EXPECT_TRUE(is_scratch_name(scratch.path().filename())) << scratch.path();
        remove_abandoned_scratch(place, 0);
        EXPECT_TRUE(fs::exists(scratch.path()));
    }
    ::unsetenv("TMPDIR");
    EXPECT_TRUE(fs::is_empty(place));
}

TEST_F(AbandonedScratch, OneThatWasMadeJustNowStays) {
    const fs::path young = made("mpipov-rank0.aB3dEf");
    remove_abandoned_scratch(base(), 60);
    EXPECT_TRUE(fs::exists(young));
}

TEST_F(AbandonedScratch, WhatIsNotOursStays) {
    const fs::path open_to_all = made("mpipov-rank0.aB3dEf"), unmarked = made("mpipov-film.backup");
    fs::permissions(open_to_all, fs::perms::group_read, fs::perm_options::add);
    fs::permissions(unmarked, fs::perms::owner_all);
    const fs::path elsewhere = made("elsewhere"), link = base() / "mpipov-rank1.aB3dEf";
    fs::create_directory_symlink(elsewhere, link);
    const fs::path file = base() / "mpipov-rank2.aB3dEf";
    std::ofstream(file) << "x";
    remove_abandoned_scratch(base(), 0);
    for (const fs::path& path : {open_to_all, unmarked, elsewhere / "launch", link, file})
        EXPECT_TRUE(fs::exists(path)) << path;
}

TEST_F(AbandonedScratch, WhatALinkInItLeadsToStays) {
    const fs::path elsewhere = made("elsewhere"), left = made("mpipov-rank0.aB3dEf");
    fs::create_directory_symlink(elsewhere, left / "view");
    remove_abandoned_scratch(base(), 0);
    EXPECT_FALSE(fs::exists(left));
    EXPECT_TRUE(fs::exists(elsewhere / "launch" / "section.png"));
}

TEST(ScratchName, IsOursToTheLetter) {
    EXPECT_TRUE(is_scratch_name("mpipov-rank0.a1B2c3"));
    for (const char* name :
         {"", "mpipov-", "mpipov-.a1B2c3", "mpipov-rank0-a1B2c3", "mpipov-rank0.a1B2c",
          "mpipov-rank0.a1B2c34", "mpipov-my results.a1B2c3", "mpipov-Rank.a1B2c3",
          "mpipov-rank0.a1B2c_", "xmpipov-rank0.a1B2c3"})
        EXPECT_FALSE(is_scratch_name(name)) << name;
}

}  // namespace
}  // namespace mpipov
