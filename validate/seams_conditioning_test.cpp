// `seams` where the scene is to be blamed: two boxes in the same place, and an mpiexec that puts
// another image in place of the one that was rendered.
#include "program_test.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class SeamsOfAnIllConditionedScene : public ProgramTest {
  protected:
    SeamsOfAnIllConditionedScene() : ProgramTest({"seams"}) {}

    void SetUp() override {
        std::ofstream(path("boxes.pov"))
            << "#version 3.7; global_settings { assumed_gamma 1 }\n"
               "#ifndef (Mpipov_Camera_Move) #declare Mpipov_Camera_Move = 0; #end\n"
               "camera {\n"
               "  location <1.3, 2.1, -4.7> look_at 0 angle 40 scale 1 + Mpipov_Camera_Move\n"
               "}\n"
               "light_source { <5, 10, -10> rgb 1 }\n"
               "box { -1, <1, 0.7, 1> pigment { rgb x } rotate y*30 }\n"
               "box { -1/3, <1, 0.7, 1>/3 pigment { rgb z } rotate y*50 scale 3 rotate -y*20 }\n";
    }

    // What the case comes to where the image is what POV-Ray makes of these arguments.
    json judge_instead(const std::string& other) {
        std::ofstream(path("other-mpiexec"))
            << "#!/bin/sh\nmpiexec \"$@\" || exit\nfor last; do :; done\n"
            << "povray " << other << " +W64 +H48 -A +WT1 -D +Oother.png || exit\n"
            << "cp other.png \"${last#+O}.png\"\n";
        fs::permissions(path("other-mpiexec"), fs::perms::owner_all);
        code_ = run({"boxes.pov", "+W64", "+H48", "-A", "--out", "out", "--ranks", "1",
                     "--sections", "2", "--seams", "aligned", "--mpiexec", "./other-mpiexec"});
        std::ifstream in(path("out/seams.json"));
        const json found = json::parse(in);
        EXPECT_EQ(found["conditioning"]["verdict"]["verdict"], "ill-conditioned");
        EXPECT_THAT(output_, HasSubstr("The scene is ill-conditioned: "));
        return found["cases"][0]["verdict"];
    }

    int code_ = -1;
};

TEST_F(SeamsOfAnIllConditionedScene, AreNotBlamedForIt) {
    const json verdict = judge_instead("boxes.pov Declare=Mpipov_Camera_Move=1e-10");
    EXPECT_EQ(code_, 0) << output_;
    EXPECT_EQ(verdict["verdict"], "ill-conditioned") << verdict;
    EXPECT_TRUE(verdict["ok"].get<bool>());
}

TEST_F(SeamsOfAnIllConditionedScene, AreBlamedForMore) {
    const json verdict = judge_instead(fmt::format("{}/basic/spheres.pov", MPIPOV_SCENES));
    EXPECT_EQ(code_, 1) << output_;
    EXPECT_EQ(verdict["verdict"], "differs");
    EXPECT_THAT(verdict["why"].get<std::string>(), HasSubstr("the scene is ill-conditioned, but"));
}

}  // namespace
}  // namespace mpipov
