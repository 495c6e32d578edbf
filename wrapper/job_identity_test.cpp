#include "job_identity.h"

#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace mpipov {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class JobIdentityTest : public testing::Test {
  protected:
    JobIdentityTest() {
        probe_.result.image.input_file = path("a.pov");
        probe_.result.image.output_file = path("a.png");
        probe_.result.image.width = 64;
        probe_.result.image.height = 48;
        probe_.result.image.region = {0, 0, 64, 48};
        probe_.settings = {{"Create_Ini", "/tmp/1/x"},
                           {"Width", "64"},
                           {"Declare", "a=1"},
                           {"Declare", "b=2"},
                           {"Include_Header", "/tmp/1/y"},
                           {"Library_Path", path("lib")}};
        write("a.pov", "#include \"b.inc\"");
        std::filesystem::create_directory(path("lib"));
        write("lib/b.inc", "");
    }
    std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path(name)) << text;
    }
    json identity() const { return job_identity(probe_, arguments_, "3.7.0"); }

    Probe probe_;
    std::vector<std::string> arguments_{"a.pov", "+W64"};

  private:
    const ScratchFolder scratch_{"job-identity-test"};
};

TEST_F(JobIdentityTest, IsTheSameAgain) {
    const json before = identity();
    probe_.settings[0].second = "/tmp/2/x";
    probe_.settings[4].second = "/tmp/2/y";
    write("a.png", "what the run wrote");
    EXPECT_EQ(identity(), before);
    EXPECT_EQ(what_changed(before, identity()), "");
}

// Reading it would take longer than the picture, without an end on ^C.
TEST_F(JobIdentityTest, AHugeFileCountsByItsSizeAndTime) {
    write("a.pov", "#declare Name = \"huge.df3\";");
    write("lib/huge.df3", "x");
    constexpr std::uintmax_t tib = std::uintmax_t{1} << 40;
    std::filesystem::resize_file(path("lib/huge.df3"), 3 * tib);
    const json before = identity();
    std::filesystem::resize_file(path("lib/huge.df3"), 3 * tib + 1);
    EXPECT_THAT(what_changed(before, identity()), HasSubstr("huge.df3' changed"));
}

TEST_F(JobIdentityTest, NamesTheSetting) {
    const json before = identity();
    probe_.settings[1].second = "65";
    EXPECT_EQ(what_changed(before, identity()), "Width changed from 64 to 65");
    probe_.settings[1] = {"Quality", "3"};
    EXPECT_EQ(what_changed(before, identity()), "Quality changed from nothing to 3");
    probe_.settings[1] = {"Width", "64"};
    probe_.settings[3].second = "b=3";
    EXPECT_EQ(what_changed(before, identity()), "Declare changed from a=1, b=2 to a=1, b=3");
}

TEST_F(JobIdentityTest, NamesTheFile) {
    const json before = identity();
    write("lib/b.inc", "#declare X = 1;");
    EXPECT_EQ(what_changed(before, identity()), "'" + path("lib/b.inc") + "' changed");
    write("lib/b.inc", "");
    write("b.inc", "");
    EXPECT_EQ(what_changed(before, identity()), "'" + path("b.inc") + "' was added");
    EXPECT_EQ(what_changed(identity(), before), "'" + path("b.inc") + "' is no longer there");
}

TEST_F(JobIdentityTest, NamesWhateverElseThereIs) {
    const json before = identity();
    probe_.result.image.region.x0 = 4;
    EXPECT_EQ(what_changed(before, identity()),
              "the region changed from columns 1 to 64, rows 1 to 48 to columns 5 to 64, rows 1 to "
              "48");
    probe_.result.image.region.x0 = 0;
    arguments_.push_back("+P");
    EXPECT_EQ(what_changed(before, identity()),
              "the arguments changed from 'a.pov +W64' to 'a.pov +W64 +P'");
    EXPECT_EQ(what_changed({{"x", 1}}, {{"x", 2}}), "the x changed from 1 to 2");
    EXPECT_THAT(what_changed({{"settings", 1}}, {{"settings", 2}}), HasSubstr("settings"));
    EXPECT_THAT(what_changed({{"files", 1}}, json::object()), HasSubstr("files"));
    EXPECT_THAT(what_changed(3, before), HasSubstr("version"));
}

}  // namespace
}  // namespace mpipov
