// What is defined where nothing differs, and at the ends of every range: JSON, table and page of
// the programs say the same.
#include "program_test.h"
#include "test_image.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace mpipov {
namespace {

using nlohmann::json;
using OIIO::TypeDesc;
using testing::HasSubstr;
using testing::Not;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double half_largest = 65504, half_smallest = 0x1p-24;
constexpr double float_smallest = std::numeric_limits<float>::denorm_min();
constexpr int width = 24, height = 16;

// One pair of images of one value each, but for `b_first`, B's first sample.
struct Definition {
    const char* name;
    TypeDesc type;
    double a, b;
    double b_first;
    double psnr;  // infinite and NaN: none, for these reasons
    double mean_abs, rms;
    double ssim;  // NaN: none
};

// SSIM of two values that fill an image: the formula without variance.
double ssim_of(double p, double q) {
    return (2 * p * q + 1e-4) / (p * p + q * q + 1e-4);
}

std::vector<Definition> definitions() {
    const auto all = [](const char* name, const TypeDesc& type, double a, double b, double full) {
        const double error = std::abs(b - a);
        const double psnr = error == 0 ? infinity : 20 * std::log10(full / error);
        return Definition{name, type, a, b, b, psnr, error, error, ssim_of(a / full, b / full)};
    };
    std::vector<Definition> cases{
        all("black", TypeDesc::UINT8, 0, 0, 255),
        all("equal constants", TypeDesc::UINT16, 65535, 65535, 65535),
        all("constants", TypeDesc::UINT8, 50, 100, 255),
        all("16 bits from end to end", TypeDesc::UINT16, 0, 65535, 65535),
        all("largest half", TypeDesc::HALF, half_largest, half_largest, 1),
        all("half from end to end", TypeDesc::HALF, -half_largest, half_largest, 1),
        all("smallest half", TypeDesc::HALF, 0, half_smallest, 1),
        all("smallest float", TypeDesc::FLOAT, 0, float_smallest, 1),
        {"signs of zero", TypeDesc::FLOAT, 0.0, -0.0, -0.0, infinity, 0, 0, 1},
        {"NaN in both", TypeDesc::FLOAT, nan, nan, nan, nan, nan, nan, 1},
        {"NaN in one", TypeDesc::HALF, 0.5, nan, nan, nan, nan, nan, nan},
        {"one infinity", TypeDesc::FLOAT, 0.5, 0.5, infinity, infinity, 0, 0, nan},
    };
    return cases;
}

class Definitions : public ProgramTest {
  protected:
    Definitions() : ProgramTest({}) {}

    void write(const std::string& name, const Definition& of, double value, double first) const {
        TestImage image{width, height, 1, std::vector<double>(width * height, value)};
        image.values[0] = first;
        if (of.type == TypeDesc::HALF || of.type == TypeDesc::FLOAT)
            for (double& sample : image.values) sample *= 255;  // which write_image divides by
        write_image(path(name), image, of.type);
    }

    // Nothing is lost by brackets and links: the cells of the row that names the case.
    static std::vector<std::string> cells(const std::string& page, const std::string& name) {
        std::vector<std::string> found;
        std::size_t at = page.find("<small>" + name + "</small>");
        const std::size_t end = page.find("</tr>", at);
        const std::string open = "<td class=\"n\">", close = "</td>";
        while ((at = page.find(open, at)) < end) {
            at += open.size();
            found.push_back(page.substr(at, page.find(close, at) - at));
        }
        return found;
    }
};

void expect_number(const json& found, double expected) {
    if (!std::isfinite(expected)) {
        EXPECT_TRUE(found.is_null()) << found;
    } else {
        EXPECT_NEAR(found.get<double>(), expected, std::abs(expected) * 1e-12);
    }
}

TEST_F(Definitions, AreTheSameInJsonTableAndReport) {
    json seams = json::parse(R"({"format": "mpipov-seams", "version": 1, "scene": "edges",
        "complete": true, "failure": null, "image": {}, "effects": {}, "references": {},
        "cases": []})");
    for (const Definition& of : definitions()) {
        SCOPED_TRACE(of.name);
        const bool integer = of.type == TypeDesc::UINT8 || of.type == TypeDesc::UINT16;
        const std::string type = integer ? "png" : "exr";
        write("a." + type, of, of.a, of.a);
        write("b." + type, of, of.b, of.b_first);
        const int code = run({"compare", "a." + type, "b." + type, "--json", "out.json"});
        const std::string table = output_;
        std::ifstream in(path("out.json"));
        const json found = json::parse(in);
        ASSERT_EQ(code, found.at("identical").get<bool>() ? 0 : 1) << table;

        expect_number(found.at("psnr"), of.psnr);
        const json& reason = found.at("psnr_reason");
        if (std::isfinite(of.psnr)) {
            EXPECT_TRUE(reason.is_null());
            EXPECT_THAT(table, HasSubstr(fmt::format("\nPSNR               {:.4f} dB", of.psnr)));
        } else {
            EXPECT_THAT(reason.get<std::string>(),
                        testing::StartsWith(std::isnan(of.psnr) ? "undefined: " : "infinite: "));
            EXPECT_THAT(table, HasSubstr("\nPSNR               " + reason.get<std::string>()));
        }
        const std::string scale = integer ? "levels" : "full_scale";
        for (const auto& [key, row, expected] :
             {std::tuple{"mean_abs", "mean error         ", of.mean_abs},
              {"rms", "RMS error          ", of.rms}}) {
            expect_number(found.at(key).is_null() ? json() : found.at(key).at(scale), expected);
            EXPECT_THAT(table,
                        HasSubstr(std::isnan(expected) ? fmt::format("\n{}none\n", row)
                                                       : fmt::format("\n{}{:.6g}", row, expected)));
        }
        EXPECT_EQ(found.at("largest").is_null(), !(of.rms > 0));
        const json& ssim = found.at("ssim").at("value");
        if (std::isnan(of.ssim)) {
            EXPECT_TRUE(ssim.is_null());
            EXPECT_THAT(table, HasSubstr("\nSSIM               none: "));
        } else {
            EXPECT_NEAR(ssim.get<double>(), of.ssim, 1e-12);
            EXPECT_THAT(table, HasSubstr(fmt::format("\nSSIM               {:.8f}", of.ssim)));
        }
        const bool identical = found.at("identical");
        seams["cases"].push_back(
            {{"name", of.name},
             {"verdict",
              {{"verdict", identical ? "identical" : "differs"}, {"ok", true}, {"why", "so"}}},
             {"comparison", found}});
    }
    std::ofstream(path("seams.json")) << seams;
    ASSERT_EQ(run({"report", "."}), 0) << output_;
    std::ostringstream page;
    page << std::ifstream(path("report.html")).rdbuf();
    for (const Definition& of : definitions()) {
        SCOPED_TRACE(of.name);
        const auto row = cells(page.str(), of.name);  // differing, largest, SSIM, PSNR, ...
        ASSERT_GE(row.size(), 4U);
        const std::string none = "–";
        if (!(of.rms > 0)) {
            EXPECT_EQ(row[1], std::isnan(of.rms) ? none : "0");
        }
        EXPECT_EQ(row[2], std::isnan(of.ssim) ? none : fmt::format("{:.5f}", of.ssim));
        EXPECT_EQ(row[3], std::isnan(of.psnr)   ? none
                          : std::isinf(of.psnr) ? "∞"
                                                : fmt::format("{:.1f}", of.psnr));
    }
    EXPECT_THAT(page.str(), Not(HasSubstr("nan dB")));
}

}  // namespace
}  // namespace mpipov
