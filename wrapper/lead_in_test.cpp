#include "lead_in.h"

#include "image_test_support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace mpipov {
namespace {

using namespace std::string_literals;

struct LeadInCase {
    std::string type, lead_in, rest;
};

void PrintTo(const LeadInCase& c, std::ostream* out) {
    *out << c.type;
}

std::string name_of(const testing::TestParamInfo<LeadInCase>& info) {
    return info.param.type;
}

class LeadIn : public testing::TestWithParam<LeadInCase> {};

TEST_P(LeadIn, EndsWhereTheImageBegins) {
    const auto& [type, lead_in, rest] = GetParam();
    EXPECT_EQ(lead_in_size(type, as_bytes(lead_in + rest)), lead_in.size());
    EXPECT_EQ(lead_in_size(type, as_bytes(lead_in.substr(0, lead_in.size() - 1))), std::nullopt);
}

TEST_P(LeadIn, IsReplacedInAStreamOfAnyPieces) {
    const auto& [type, lead_in, rest] = GetParam();
    const ScratchFolder folder("lead-in-test");
    const auto file = folder.path() / "sample";
    write_text(file, lead_in + rest);
    const auto replacement = read_lead_in(type, file);
    EXPECT_EQ(as_text(replacement), lead_in);

    const std::string shorter = type == "hdr"    ? "#?RADIANCE\n\n"
                                : type == "jpeg" ? "\xff\xd8\xff\xe0\x00\x03j"s
                                                 : "P6\n";
    const std::string stream = shorter + rest;
    for (const std::size_t piece : {1, 4, 1000}) {
        std::string out;
        LeadInFilter filter(type, replacement,
                            [&](std::span<const std::byte> bytes) { out += as_text(bytes); });
        for (std::size_t at = 0; at < stream.size(); at += piece)
            filter.write(as_bytes(std::string_view(stream).substr(at, piece)));
        EXPECT_EQ(out, lead_in + rest) << "pieces of " << piece;
        EXPECT_TRUE(filter.complete());
    }
}

TEST_P(LeadIn, IsMissedInAnotherKindOfFile) {
    const ScratchFolder folder("lead-in-test");
    const auto file = folder.path() / "other";
    write_text(file, std::string(5000, 'x') + "\n\n1234");
    EXPECT_THROW(read_lead_in(GetParam().type, file), std::runtime_error);
    EXPECT_THROW(read_lead_in(GetParam().type, folder.path() / "none"), std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(
    Types, LeadIn,
    testing::Values(LeadInCase{"hdr", "#?RADIANCE\nSOFTWARE=POV-Ray\nFORMAT=32-bit_rle_rgbe\n\n",
                               "-Y 3 +X 4\n\n\npixels"},
                    LeadInCase{"pnm", "P6\n# 8 by 8, not\n", "12 4\n255\n0123"},
                    LeadInCase{"jpeg", "\xff\xd8\xff\xe0\x00\x04zz\xff\xfe\x00\x05\xff\xdbz"s,
                               "\xff\xdb\x00\x04tables"s}),
    name_of);

TEST(LeadInTypes, OthersHaveNone) {
    EXPECT_THROW(lead_in_size("targa", {}), std::invalid_argument);
}

}  // namespace
}  // namespace mpipov
