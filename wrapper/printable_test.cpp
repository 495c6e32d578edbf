#include "printable.h"

#include <gtest/gtest.h>

namespace mpipov {
namespace {

TEST(Printable, LeavesNoControlCharacterToATerminal) {
    EXPECT_EQ(printable("\x1b]0;title\x07"), "?]0;title?");
    EXPECT_EQ(printable("a\rb\x7f"), "a?b?");
    EXPECT_EQ(printable("a\xc2\x9b"
                        "31m"),
              "a?31m")
        << "CSI in one character";
}

TEST(Printable, LeavesTextAsItIs) {
    EXPECT_EQ(printable("two\nlines\tand a blank"), "two\nlines and a blank");
    EXPECT_EQ(printable("sch\xc3\xb6n \xc2\xb5"), "sch\xc3\xb6n \xc2\xb5");
    EXPECT_EQ(printable("sch\xf6n\xc2"), "sch\xf6n\xc2") << "no UTF-8";
}

}  // namespace
}  // namespace mpipov
