// `stability` as a program, with the POV-Ray that is installed.
#include "image_source.h"
#include "program_test.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

constexpr const char* head =
    "#version 3.7;\nglobal_settings { assumed_gamma 1 }\nlight_source { <5, 10, -10> rgb 1 }\n";
constexpr const char* view = "{ location <1.3, 2.1, -4.7> look_at 0 angle 40 }\n";
constexpr const char* ball = "sphere { 0, 1.3 pigment { rgb <1, 0.2, 0.1> } }\n";
// The same box twice, by way of other numbers.
constexpr const char* boxes =
    "box { -1, <1, 0.7, 1> pigment { rgb x } rotate y*30 }\n"
    "box { -1/3, <1, 0.7, 1>/3 pigment { rgb z } rotate y*50 scale 3 rotate -y*20 }\n";

class StabilityProgram : public ProgramTest {
  protected:
    StabilityProgram() : ProgramTest({"stability"}) {}

    std::string write(const std::string& name, const std::string& text) const {
        fs::create_directories(path(name).parent_path());
        std::ofstream(path(name)) << text;
        return name;
    }
    std::string text_of(const std::string& name) const {
        std::ifstream in(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    int measure(const std::string& file, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{file, "+W48", "+H36", "--out", "out"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    json found() const { return json::parse(text_of("out/stability.json")); }
};

TEST_F(StabilityProgram, ASphereIsWellConditioned) {
    const std::string text = std::string(head) + "camera " + view + ball;
    write("ball.pov", text);
    EXPECT_EQ(measure("ball.pov", {"+A0.3", "--require-well", "--json", "-"}), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("\"verdict\": \"well-conditioned\""));
    EXPECT_EQ(text_of("ball.pov"), text);
    const json j = found();
    EXPECT_TRUE(j["complete"].get<bool>());
    EXPECT_EQ(j["cameras"], 1);
    EXPECT_EQ(j["moved_by"], "scale");
    EXPECT_TRUE(j["verdict"]["well"].get<bool>());
    ASSERT_THAT(j["moves"], SizeIs(3));
    EXPECT_EQ(j["moves"][0]["move"], 1e-12);
    EXPECT_EQ(j["moves"][0]["differing"], 0);
    // Either 1e-6 changes something, or it was shown that the camera can be moved at all.
    const json& least = j["moves"][2]["differing"] > 0 ? j["moves"][2] : j["control"];
    EXPECT_GT(least["differing"], 0);
    if (least["move"] == 1e-3) {
        EXPECT_GT(least["answering"], 0);
    }
    EXPECT_GT(least["amplification"].get<double>(), 0);
}

TEST_F(StabilityProgram, CoincidentSurfacesAreIllConditioned) {
    write("boxes.pov", std::string(head) + "camera " + view + boxes);
    EXPECT_EQ(measure("boxes.pov", {"--require-well"}), 1) << output_;
    EXPECT_THAT(output_, HasSubstr("\nill-conditioned: "));
    const json j = found();
    EXPECT_EQ(j["verdict"]["verdict"], "ill-conditioned");
    EXPECT_GT(j["moves"][0]["answering"], 48 * 36 / 100);
    EXPECT_GT(j["moves"][0]["amplification"].get<double>(), 1e9);
    ImageSource map(path("out") / j["map"].get<std::string>());
    ImageBand band;
    ASSERT_TRUE(map.next_band(36, band));
    EXPECT_EQ(std::count(band.values.begin(), band.values.end(), 255),
              j["moves"][0]["answering"].get<long long>());
    EXPECT_TRUE(fs::exists(path("out") / j["moves"][2]["image"].get<std::string>()));
}

// The camera is declared in a file that is included by one that is included, by a name that only
// the library path finds, and both folders have blanks in their names.
TEST_F(StabilityProgram, ACameraInWhatIsIncludedIsMoved) {
    write("a scene/ball.pov", std::string(head) + "#include \"outer.inc\"\n" + ball);
    write("some files/outer.inc", "#include \"inner\"\ncamera { View }\n");
    write("some files/inner.inc", std::string("#declare View = camera ") + view);
    EXPECT_EQ(measure("a scene/ball.pov", {"+Lsome files"}), 0) << output_;
    EXPECT_EQ(found()["moved_by"], "scale");
    EXPECT_EQ(found()["cameras"], 1);
}

TEST_F(StabilityProgram, ACameraAtTheOriginIsShifted) {
    write("ball.pov", std::string(head) + "camera { location 0 look_at z }\n" +
                          "sphere { 3*z, 1.3 pigment { rgb 1 } }\n");
    EXPECT_EQ(measure("ball.pov"), 0) << output_;
    EXPECT_EQ(found()["moved_by"], "shift");
}

TEST_F(StabilityProgram, AScenesOwnMoveIsUsed) {
    write("ball.pov", std::string(head) +
                          "#ifndef (Mpipov_Camera_Move) #declare Mpipov_Camera_Move = 0; #end\n"
                          "#declare Place = (1 + Mpipov_Camera_Move) * <1.3, 2.1, -4.7>;\n"
                          "camera { location Place look_at 0 angle 40 }\n" +
                          ball);
    EXPECT_EQ(measure("ball.pov"), 0) << output_;
    EXPECT_EQ(found()["moved_by"], "declared");
}

TEST_F(StabilityProgram, ACameraThatCannotBeMovedIsToldAndNotPassedOver) {
    write("hidden.inc", std::string("camera ") + view);
    write("ball.pov", std::string(head) + "#declare Name = concat(\"hid\", \"den.inc\");\n" +
                          "#include Name\n" + ball);
    EXPECT_EQ(measure("ball.pov"), 3) << output_;
    EXPECT_THAT(output_, HasSubstr("cannot move the camera of 'ball.pov'"));
    EXPECT_THAT(output_, HasSubstr("scale 1 + Mpipov_Camera_Move"));
    EXPECT_FALSE(found()["complete"].get<bool>());
    EXPECT_TRUE(found()["verdict"].is_null());
    EXPECT_THAT(found()["failure"].get<std::string>(), HasSubstr("cannot move"));
}

TEST_F(StabilityProgram, OtherErrors) {
    EXPECT_EQ(run({}), 2);
    EXPECT_THAT(output_, HasSubstr("no scene"));
    EXPECT_EQ(run({"ball.pov", "--nonsense"}), 2);
    EXPECT_EQ(run({"missing.pov"}), 3);
    EXPECT_EQ(run({"--help"}), 0);
    for (const char* option : {"--out", "--require-well", "--json", "Exit code"})
        EXPECT_THAT(output_, HasSubstr(option));
}

}  // namespace
}  // namespace mpipov
