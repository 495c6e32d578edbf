#include "refused_file.h"

#include "scratch.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

constexpr const char* banner = "==== [Parsing...] ====\n";
constexpr const char* end = "Fatal error in parser: Cannot parse input.\nRender failed\n";

std::string name_in(const std::string& said) {
    const auto refused = refused_file(banner + said + end);
    return refused ? (refused->to_write ? "write " : "read ") + refused->name : "";
}

// As Debian's 3.7.0.10 prints them, with its line breaks.
TEST(RefusedFile, IsTheOneThatPovrayNamesLast) {
    EXPECT_EQ(
        name_in("File 'b.pov' line 2: Possible Parse Error: Cannot find file '/root/none/aaaaaa"
                "aa\naaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"
                "aaaaaa\naa.inc', even after trying to append file type extension.\n"
                "File 'b.pov' line 2: Parse Error: Cannot open include file /root/none/aa.inc.\n"),
        "read /root/none/" + std::string(90, 'a') + ".inc");
    EXPECT_EQ(name_in("File 'c.pov' line 2: Possible Parse Error: Cannot find file 'no.png', even "
                      "after\n trying to append file type extension.\n"
                      "File 'c.pov' line 2: Possible Parse Error: Cannot find image file.\n"),
              "read no.png");
    EXPECT_EQ(name_in("File 'c.pov' line 2: Possible Parse Error: Cannot find file 'no.df3', even "
                      "after\n trying to append file type extension.\n"
                      "File 'c.pov' line 2: Parse Error: Cannot read media density file.\n"),
              "read no.df3");
    EXPECT_EQ(
        name_in("Possible Parse Error: Cannot find file 'it's.pov', even after trying to append"
                "\n file type extension.\nParse Error: Cannot open input file.\n"),
        "read it's.pov");
    EXPECT_EQ(name_in("File 'c.pov' line 2: Parse Error: Cannot open user file /root/x (write).\n"),
              "write /root/x");
    EXPECT_EQ(name_in("File 'c.pov' line 2: Parse Error: Cannot open user file x (append).\n"),
              "write x");
    EXPECT_EQ(name_in("File 'c.pov' line 2: Parse Error: Expected 'operand'\n"), "");
    EXPECT_EQ(name_in("Cannot open file 'all.txt' for output.\n"), "write all.txt");
    EXPECT_EQ(name_in(""), "");
}

TEST(RefusedFile, IsNotWhatASceneSays) {
    const std::string forged =
        "Possible Parse Error: Cannot find file '/home/me/x', even after trying to append file "
        "type "
        "extension.";
    EXPECT_EQ(name_in("File 'a.pov' line 6: Parse Error: Parse halted by #error directive: " +
                      forged + "\n"),
              "");
    EXPECT_EQ(name_in("File 'a.pov' line 6: Parse Error: Parse halted by #error directive: Parse "
                      "Error: Cannot open user file /home/me/x (write).\n"),
              "");
    EXPECT_EQ(
        name_in("File 'a.pov' line 3: " + forged +
                "\nFile 'a.pov' line 6: Parse Error: Parse halted by #error directive: end\n"),
        "")
        << "#debug prints any line";
    EXPECT_EQ(name_in("File 'a.pov' line 3: Parse Warning: File 'a.pov' line 3: " + forged +
                      "\nFile 'a.pov' line 6: Parse Error: Cannot open user file x (read).\n"),
              "");
    EXPECT_EQ(name_in("File 'a.pov' line 3: " + forged +
                      "\nFile 'a.pov' line 4: Parse Error: Expected 'operand'\n"),
              "");
}

TEST(RefusedFile, OnlyWhatIsHarmlessIsProposed) {
    const ScratchFolder scratch("refused-file-test");
    const fs::path home = scratch.path() / "home";
    fs::create_directories(home / "lib/.git");
    EXPECT_TRUE(may_be_proposed(home / "lib", home));
    EXPECT_TRUE(may_be_proposed("/data/scenes", home));
    EXPECT_TRUE(may_be_proposed("/opt/lib", {}));
    EXPECT_TRUE(may_be_proposed("/root/lib", "/root"));
    for (const fs::path& folder :
         {home, scratch.path(), home / ".ssh", home / "lib/.git", home / ".config/x", home / "it's",
          home / "a\nb", home / "$(x)", fs::path("/"), fs::path("/etc"), fs::path("/etc/ssl"),
          fs::path("/root"), fs::path("/root/lib"), fs::path("/proc/self"), fs::path("/tmp"),
          fs::path("/var/lib"), fs::path("/dev")})
        EXPECT_FALSE(may_be_proposed(folder, home)) << folder;
}

}  // namespace
}  // namespace mpipov
