// `simulate` as a program.

#include "program_test.h"
#include "run_record.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace mpipov {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class SimulateProgram : public ProgramTest {
  protected:
    SimulateProgram() : ProgramTest({"simulate"}) {}

    json read(const char* name = "out.json") const {
        std::ifstream in(path(name));
        return json::parse(in);
    }
    void write(const char* name, const std::string& text) const {
        std::ofstream(path(name)) << text;
    }
};

const json map = {
    {"format", "mpipov-costs"},
    {"version", 1},
    {"width", 256},
    {"height", 256},
    {"rectangles", {{{"x0", 0}, {"y0", 0}, {"x1", 256}, {"y1", 256}, {"cpu_seconds", 64}}}}};

TEST_F(SimulateProgram, PrintsATableAndWritesAll) {
    write("costs.json", map.dump());
    ASSERT_EQ(run({"--costs", "costs.json", "--ranks", "1,4", "--ranks-per-host", "2", "--schedule",
                   "cost", "--json", "out.json"}),
              0)
        << output_;
    EXPECT_THAT(output_, HasSubstr("SIMULATED"));
    EXPECT_THAT(output_, HasSubstr("Terms off"));
    const json found = read();
    EXPECT_EQ(found["format"], "mpipov-simulation");
    EXPECT_EQ(found["costs"]["cpu_seconds"], 64);
    ASSERT_EQ(found["rows"].size(), 2U);
    EXPECT_EQ(found["rows"][1]["ranks"], 4);
    EXPECT_GT(found["rows"][1]["speedup"].get<double>(), 3);
    EXPECT_LT(found["rows"][1]["efficiency"].get<double>(), 1);
    bool network = false;
    for (const json& term : found["terms"])
        if (term["name"] == "latency") network = term["on"];
    EXPECT_TRUE(network) << "there are two hosts";
}

TEST_F(SimulateProgram, SaysWhatIsMadeUp) {
    ASSERT_EQ(run({"--serial-seconds", "100", "--size", "640x480", "--ranks", "2"}), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("spread evenly"));
    ASSERT_EQ(run({"--serial-seconds", "100", "--size", "640x480", "--map", "hill", "--ranks", "2",
                   "--json", "-"}),
              0);
    EXPECT_EQ(json::parse(output_)["costs"]["from"], "a made-up hill");
    EXPECT_NEAR(json::parse(output_)["serial_seconds"].get<double>(), 100, 1e-6);
}

TEST_F(SimulateProgram, ABarIsMetOrMissed) {
    const std::vector<std::string> base{"--serial-seconds", "1000",    "--size",
                                        "640x480",          "--ranks", "8"};
    auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), base.begin(), base.end());
        return run(more);
    };
    EXPECT_EQ(with({"--bar", "8:0.9"}), 0) << output_;
    EXPECT_EQ(with({"--bar", "8:0.9", "--after", "1000"}), 1) << output_;
    EXPECT_THAT(output_, HasSubstr("MISSED"));
    EXPECT_THAT(output_, HasSubstr("met without after"));
    EXPECT_EQ(with({"--bar", "8:0.9", "--after", "1000", "--without", "after"}), 0) << output_;
    EXPECT_EQ(with({"--bar", "9:0.9"}), 2);
    EXPECT_EQ(with({"--bar", "0.9"}), 2);
}

TEST_F(SimulateProgram, ThePaperIsThereWithWhatIsKnownOfIt) {
    ASSERT_EQ(run({"--paper", "--serial-seconds", "60", "--size", "640x480", "--json", "out.json"}),
              0)
        << output_;
    EXPECT_THAT(output_, HasSubstr("MPIPOV1 on 8: 6.66"));
    EXPECT_THAT(output_, HasSubstr("fitted"));
    const json found = read();
    EXPECT_TRUE(found["rows"][0]["mpipov2"].is_null()) << "needs two ranks";
    for (const json& cell : found["cells"])
        EXPECT_NEAR(cell["model"].get<double>() / cell["paper"].get<double>(), 1, 0.12);
    EXPECT_EQ(found["rows"].back()["ranks"], 8);
    EXPECT_GE(found["rows"].back()["ours"].get<double>(), 7.6);
    ASSERT_EQ(run({"--paper", "--serial-seconds", "60", "--size", "640x480", "--paper-latency", "0",
                   "--strips", "70"}),
              0);
    EXPECT_THAT(output_, Not(HasSubstr("fitted")));
}

TEST_F(SimulateProgram, RefusesWhatItCannotDo) {
    write("costs.json", map.dump());
    write("broken.json", "{}");
    EXPECT_EQ(run({}), 2);
    EXPECT_THAT(output_, HasSubstr("--run, --costs"));
    EXPECT_EQ(run({"--costs", "costs.json", "--serial-seconds", "1"}), 2);
    EXPECT_EQ(run({"--serial-seconds", "1"}), 2);
    EXPECT_EQ(run({"--serial-seconds", "0.1", "--size", "64x64"}), 2) << "less than a launch";
    EXPECT_EQ(run({"--serial-seconds", "9", "--size", "64"}), 2);
    EXPECT_EQ(run({"--serial-seconds", "9", "--size", "64x64", "--sections", "5"}), 2);
    EXPECT_THAT(output_, HasSubstr("4 at most"));
    EXPECT_EQ(run({"--costs", "costs.json", "--ranks", "0"}), 2);
    EXPECT_EQ(run({"--costs", "costs.json", "--speeds", "1,-1"}), 2);
    EXPECT_EQ(run({"--costs", "costs.json", "--without", "gravity"}), 2);
    EXPECT_THAT(output_, HasSubstr("'frame'"));
    EXPECT_EQ(run({"--costs", "costs.json", "--ranks", "1", "--dedicated-coordinator"}), 2);
    EXPECT_EQ(run({"--costs", "costs.json", "--coordinator-rate", "0"}), 2);
    EXPECT_EQ(run({"--costs", "costs.json", "--strips", "9"}), 2) << "only with --paper";
    EXPECT_EQ(run({"--costs", "nowhere.json"}), 4);
    EXPECT_EQ(run({"--costs", "broken.json"}), 4);
    EXPECT_EQ(run({"--run", "broken.json"}), 4);
    EXPECT_EQ(run({"--costs", "costs.json", "--json", "nowhere/out.json"}), 4);
}

}  // namespace
}  // namespace mpipov
