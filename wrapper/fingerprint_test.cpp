#include "fingerprint.h"

#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <fstream>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::StartsWith;

constexpr std::uintmax_t gib = std::uintmax_t{1} << 30;

// Of holes.
void make(const fs::path& file, std::uintmax_t bytes, std::uintmax_t at) {
    std::ofstream out(file, std::ios::binary);
    out.seekp(static_cast<std::streamoff>(at));
    out << "x";
    out.close();
    fs::resize_file(file, bytes);
}

TEST(Fingerprint, IsTheSha1OfAFile) {
    const ScratchFolder folder("fingerprint-test");
    std::ofstream(folder.path() / "a") << "abc";
    const std::string sha1 = fingerprint(folder.path() / "a");
    EXPECT_EQ(sha1, "a9993e364706816aba3e25717850c26c9cd0d89d");
    EXPECT_TRUE(is_of_whole_file(sha1));
    EXPECT_EQ(fingerprint(folder.path() / "none"), "");
    EXPECT_FALSE(is_of_whole_file(""));
}

TEST(Fingerprint, OfALargeFileIsOfPiecesAndTheSameInAnotherPlace) {
    const ScratchFolder folder("fingerprint-test");
    const fs::path one = folder.path() / "one", other = folder.path() / "other";
    const std::uintmax_t bytes = 3 * gib + 7;
    make(one, bytes, 5);
    make(other, bytes, 5);
    fs::last_write_time(other, fs::last_write_time(one) - std::chrono::hours(1));
    const std::string first = fingerprint(one);
    EXPECT_THAT(first, StartsWith("3221225479 bytes"));
    EXPECT_FALSE(is_of_whole_file(first));
    EXPECT_EQ(fingerprint(other), first) << "a copy on another host has another time";
    for (const std::uintmax_t at : {std::uintmax_t{6}, bytes - 1}) {
        make(other, bytes, at);
        EXPECT_NE(fingerprint(other), first);
    }
    make(other, bytes + 1, 5);
    EXPECT_NE(fingerprint(other), first);
}

}  // namespace
}  // namespace mpipov
