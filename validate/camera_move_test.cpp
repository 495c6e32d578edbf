#include "camera_move.h"

#include <gmock/gmock.h>

namespace mpipov {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

int count(std::string_view text, std::string_view part) {
    int found = 0;
    for (auto at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

TEST(CameraMove, StatementsAreToldFromDeclarations) {
    EXPECT_EQ(read_scene_text("camera { location 1 }").cameras, 1);
    EXPECT_EQ(read_scene_text("#declare C = camera { location 1 } camera { C }").cameras, 1);
    EXPECT_EQ(read_scene_text("#declare A = array[2] { camera {}, camera {} }").cameras, 0);
    EXPECT_EQ(read_scene_text("#default { camera { location 1 } }").cameras, 0);
    EXPECT_EQ(read_scene_text("#macro M() camera /* { */ { location 1 } #end").cameras, 1);
    EXPECT_EQ(read_scene_text("camera { normal { bumps 1 } }").cameras, 1);
    EXPECT_EQ(read_scene_text("camera { location 1").cameras, 0) << "POV-Ray refuses it too";
}

TEST(CameraMove, CommentsLiteralsAndOtherWordsAreNone) {
    for (const char* text :
         {"// camera { }", "/* camera { } /* camera { } */ camera { } */", "#debug \"camera { }\"",
          "#debug \"\\\" camera { }\"", "my_camera { }", "camera_ { }", "camera", "mesh_camera { }",
          "", "\"camera { }", "/* camera { }"})
        EXPECT_EQ(read_scene_text(text).cameras, 0) << text;
}

TEST(CameraMove, WhatIsIncludedAndWhoMovesItself) {
    const SceneText read = read_scene_text(
        "#include \"a.inc\" # include \"b.inc\" // #include \"c.inc\"\n#declare D = \"d.inc\";\n"
        "camera { location 1 scale 1 + Mpipov_Camera_Move }");
    EXPECT_THAT(read.includes, ElementsAre("a.inc", "b.inc"));
    EXPECT_TRUE(read.moves_itself);
    EXPECT_FALSE(read_scene_text("// Mpipov_Camera_Move").moves_itself);
    EXPECT_FALSE(read_scene_text("Mpipov_Camera_Move_2").moves_itself);
}

TEST(CameraMove, TheStatementEndsInTheMove) {
    const std::string text =
        "camera { normal { bumps 1 } look_at 0 } // camera { }\nsphere { 0, 1 }";
    const std::string moved = with_movable_camera(text, {});
    EXPECT_THAT(moved, StartsWith("camera { normal { bumps 1 } look_at 0 \n#debug"));
    EXPECT_THAT(moved, HasSubstr("scale 1 + Mpipov_Camera_Move\n"));
    EXPECT_THAT(moved, HasSubstr("\n} // camera { }\nsphere { 0, 1 }"));
    EXPECT_EQ(count(moved, camera_mark), 1);
    EXPECT_EQ(with_movable_camera("#declare C = camera { }", {}), "#declare C = camera { }");
    EXPECT_EQ(read_scene_text(movable_default_camera()).cameras, 1);
}

TEST(CameraMove, IncludesByOtherNames) {
    EXPECT_EQ(with_movable_camera("#include \"a.inc\"\n#include \"b.inc\"\n#debug \"a.inc\"",
                                  {{"a.inc", "/tmp/1-a.inc"}}),
              "#include \"/tmp/1-a.inc\"\n#include \"b.inc\"\n#debug \"a.inc\"");
}

}  // namespace
}  // namespace mpipov
