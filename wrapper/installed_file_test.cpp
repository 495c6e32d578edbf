#include "installed_file.h"

#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace mpipov {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(InstalledFile, LiesBesideTheProgram) {
    const auto file =
        find_installed({.name = "mpipov-guard", .folder = "../libexec", .variable = {}});
    EXPECT_EQ(file.filename(), "mpipov-guard");
    EXPECT_TRUE(std::filesystem::is_regular_file(file));
}

TEST(InstalledFile, SaysWhereItWasLookedFor) {
    EXPECT_THAT([] { find_installed({.name = "no-such", .folder = "../lib/x", .variable = {}}); },
                ThrowsMessage<std::runtime_error>(
                    AllOf(HasSubstr("cannot find no-such"), HasSubstr("lib/x/no-such'"))));
}

TEST(InstalledFile, LiesWhereTheInstallPutIt) {
    const auto here = program_folder();
    const InstalledFile wanted{.name = here.filename().string(), .folder = "..", .variable = {}};
    EXPECT_EQ(find_installed(wanted), here.parent_path() / here.filename());
    EXPECT_EQ(find_installed({.name = "sh", .folder = "/bin", .variable = {}}), "/bin/sh");
}

TEST(InstalledFile, AVariableNamesAnother) {
    const ScratchFolder folder("installed-file-test");
    const auto file = folder.path() / "other";
    std::ofstream(file) << "#!/bin/sh\n";
    const InstalledFile wanted{
        .name = "mpipov-guard", .folder = "", .variable = "MPIPOV_TEST_FILE"};
    ::setenv("MPIPOV_TEST_FILE", file.c_str(), 1);
    EXPECT_THAT([&] { find_installed(wanted); },
                ThrowsMessage<std::runtime_error>(HasSubstr("MPIPOV_TEST_FILE names")));
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    EXPECT_EQ(find_installed(wanted), file);
    ::unsetenv("MPIPOV_TEST_FILE");
}

}  // namespace
}  // namespace mpipov
