#include "png_chunks.h"

#include "image_test_support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace mpipov {
namespace {

using namespace std::string_literals;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string signature = "\x89PNG\r\n\x1a\n";

// The CRC stands in for itself: chunks are copied whole, and it is not looked at.
std::string chunk(const std::string& type, const std::string& data) {
    const std::size_t n = data.size();
    const std::string length{static_cast<char>(n >> 24), static_cast<char>(n >> 16),
                             static_cast<char>(n >> 8), static_cast<char>(n)};
    return length + type + data + "~crc";
}

std::string filtered(const std::string& png, const std::vector<PngChunk>& metadata,
                     std::size_t piece, bool* complete = nullptr) {
    std::string out;
    PngMetadataFilter filter(metadata,
                             [&](std::span<const std::byte> bytes) { out += as_text(bytes); });
    for (std::size_t at = 0; at < png.size(); at += piece)
        filter.write(as_bytes(std::string_view(png).substr(at, piece)));
    if (complete) *complete = filter.complete();
    return out;
}

MATCHER_P2(IsChunk, type, after_pixels, "") {
    return arg.type == type && arg.after_pixels == after_pixels;
}

class PngChunks : public testing::Test {
  protected:
    std::vector<PngChunk> metadata_of(const std::string& content) {
        write_text(file_, content);
        return read_png_metadata(file_);
    }

    ScratchFolder folder_{"png-chunks-test"};
    std::filesystem::path file_ = folder_.path() / "sample.png";
};

const std::string header = chunk("IHDR", "thirteen byte");
const std::string sample = signature + header + chunk("gAMA", "1234") + chunk("tEXt", "a\0b"s) +
                           chunk("IDAT", "xyz") + chunk("tIME", "sevenby") + chunk("IEND", "");

TEST_F(PngChunks, ReadsAllButThePixels) {
    const auto metadata = metadata_of(sample);
    EXPECT_THAT(metadata,
                ElementsAre(IsChunk("gAMA", false), IsChunk("tEXt", false), IsChunk("tIME", true)));
    EXPECT_EQ(as_text(metadata.at(1).bytes), chunk("tEXt", "a\0b"s));
}

TEST_F(PngChunks, ReplacesTheMetadataOfAnotherFile) {
    const auto metadata = metadata_of(sample);
    const std::string pixels = chunk("IDAT", std::string(300, 'p')) + chunk("IDAT", "q");
    const std::string other = signature + chunk("IHDR", "another one..") + chunk("cHRM", "none") +
                              chunk("PLTE", "rgb") + pixels + chunk("tEXt", "late") +
                              chunk("IEND", "");
    const std::string expected = signature + chunk("IHDR", "another one..") + chunk("PLTE", "rgb") +
                                 chunk("gAMA", "1234") + chunk("tEXt", "a\0b"s) + pixels +
                                 chunk("tIME", "sevenby") + chunk("IEND", "");
    for (const std::size_t piece : {1, 3, 8, 100, 10'000}) {
        bool complete = false;
        EXPECT_EQ(filtered(other, metadata, piece, &complete), expected) << "pieces of " << piece;
        EXPECT_TRUE(complete);
    }
}

TEST_F(PngChunks, SeesThatAStreamEndsEarly) {
    bool complete = true;
    filtered(sample.substr(0, sample.size() - 1), {}, 5, &complete);
    EXPECT_FALSE(complete);
}

TEST_F(PngChunks, NamesADamagedFile) {
    const auto fails_with = [&](const std::string& content, const std::string& why) {
        try {
            metadata_of(content);
            ADD_FAILURE() << "no error: " << why;
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), AllOf(HasSubstr(file_.string()), HasSubstr(why)));
        }
    };
    fails_with("", "not a PNG");
    fails_with("GIF89a and more", "not a PNG");
    fails_with(signature, "truncated");
    fails_with(signature + header + chunk("gAMA", "1234").substr(0, 10), "gAMA");
    fails_with(signature + header + "\xff\xff\xff\xfftEXtabc", "tEXt");
    fails_with(sample.substr(0, sample.size() - 12), "IEND");
    std::filesystem::remove(file_);
    EXPECT_THROW(read_png_metadata(file_), std::runtime_error);
}

}  // namespace
}  // namespace mpipov
