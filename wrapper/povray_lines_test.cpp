#include "povray_lines.h"

#include <gmock/gmock.h>

namespace mpipov {
namespace {

using testing::IsEmpty;
using testing::Pair;
using testing::UnorderedElementsAre;

std::map<std::string, long long> counters_of(const char* line) {
    std::map<std::string, long long> counters;
    parse_counters(line, counters);
    return counters;
}

TEST(PovrayLines, Counters) {
    EXPECT_THAT(counters_of("Pixels:   12   Samples:  7   Smpls/Pxl: 0.58"),
                UnorderedElementsAre(Pair("Pixels", 12), Pair("Samples", 7), Pair("Pxl", 0)));
    EXPECT_THAT(counters_of("12 Media Intervals:  3"),
                UnorderedElementsAre(Pair("Media Intervals", 3)));
    EXPECT_THAT(counters_of("a Bc: De: 5"), UnorderedElementsAre(Pair("De", 5)));
    EXPECT_THAT(counters_of("Too large: 99999999999999999999"),
                UnorderedElementsAre(Pair("Too large", 0)));
    for (const char* none : {"", ":", "A: 1", "Ab:1", "Ab : 1", "ab: 1", "Ab: x", "Ab:  "})
        EXPECT_THAT(counters_of(none), IsEmpty()) << none;
}

TEST(PovrayLines, Warnings) {
    for (const char* line :
         {"Warning: a", "Parse Warning: a", "Aa Bb Warning: ", "File 'a' line 3: Parse Warning: b",
          "File 'a' line 3: ' line 12: Warning: b"})
        EXPECT_TRUE(is_warning(line)) << line;
    for (const char* line : {"", "Warning:", " Warning: a", "parse Warning: a", "A Warning: a",
                             "File 'a' line x: Warning: a", "File 'a' line 3: a",
                             "File 'a' line 3:Warning: a", "Parse  Warning: a"})
        EXPECT_FALSE(is_warning(line)) << line;
}

TEST(PovrayLines, PossibleErrors) {
    for (const char* line : {"Possible Error: a", "Possible Parse Error: a",
                             "x Possible Possible Error: ", "Possible a: Possible b Error: "})
        EXPECT_TRUE(is_possible_error(line)) << line;
    for (const char* line : {"", "Possible ", "Possible a: Error: b",
                             "Possible Error:", "PossibleError: ", "Error: Possible "})
        EXPECT_FALSE(is_possible_error(line)) << line;
}

TEST(PovrayLines, Versions) {
    EXPECT_EQ(version_in("POV-Ray 3.7.0.10.unofficial\n"), "3.7.0.10.unofficial");
    EXPECT_EQ(version_in("a\nPersistence of Vision(tm) Ray Tracer Version 3.7 (g++)"), "3.7");
    EXPECT_EQ(version_in("POV-Ray finished\nPOV-Ray 4"), "4");
    for (const char* none : {"", "POV-Ray", "POV-Ray ", " POV-Ray 3", "POV-Ray v3"})
        EXPECT_FALSE(version_in(none)) << none;
}

}  // namespace
}  // namespace mpipov
