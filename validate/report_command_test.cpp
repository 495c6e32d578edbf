// The program as a whole: which results it finds, what it finds wrong in them, exit codes, the
// page.
#include "program_test.h"
#include "report_input.h"
#include "test_image.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using OIIO::TypeDesc;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

json good_seams() {
    return json::parse(R"({"format": "mpipov-seams", "version": 1, "scene": "cube",
        "complete": true, "failure": null, "image": {}, "effects": {}, "references": {}, "cases":
        [{"name": "case-1", "verdict": {"verdict": "identical", "ok": true, "why": "equal"},
          "comparison": {"identical": true, "differing": 0}}]})");
}

class ReportCommand : public ProgramTest {
  protected:
    ReportCommand() : ProgramTest({"report"}) {}

    void write(const fs::path& name, const std::string& text) {
        fs::create_directories(path(name).parent_path());
        std::ofstream(path(name)) << text;
    }
    void write(const fs::path& name, const json& data) { write(name, data.dump()); }

    std::vector<std::string> problems_of(const json& data, const std::string& kind = "seams") {
        write(kind + ".json", data);
        return collect_results(folder_.path()).at("entries").at(0).at("problems");
    }

    std::string read(const char* name) const {
        std::ostringstream text;
        text << std::ifstream(path(name)).rdbuf();
        return text.str();
    }
};

TEST_F(ReportCommand, FindsResultsAtAnyDepthInOrder) {
    write("b/seams.json", good_seams());
    write("a/deep/er/seams.json", good_seams());
    write("speedup.json", json{{"rows", json::array()}});
    write("a/noise.json", json{{"noise", json::object()}});
    write("a/other.json", json::object());
    fs::create_directory(path("c"));
    fs::create_directory(path("c/seams.json"));
    fs::create_directory_symlink(path("b"), path("link"));
    std::vector<std::string> found;
    const json input = collect_results(folder_.path());
    for (const json& entry : input.at("entries")) {
        found.push_back(entry.at("kind").get<std::string>() + " " +
                        entry.at("file").get<std::string>());
        EXPECT_THAT(entry.at("problems"), IsEmpty());
    }
    EXPECT_THAT(found, ElementsAre("seams a/deep/er/seams.json", "noise a/noise.json",
                                   "seams b/seams.json", "speedup speedup.json"));
    EXPECT_EQ(input.at("entries").at(2).at("folder"), path("b").string());
    EXPECT_EQ(input.at("entries").at(2).at("data"), good_seams());
}

TEST_F(ReportCommand, SaysWhatLacks) {
    EXPECT_THAT(problems_of(good_seams()), IsEmpty());
    json data = good_seams();
    data.erase("effects");
    data["scene"] = 7;
    data["version"] = 2;
    EXPECT_THAT(problems_of(data),
                ElementsAre("its version is 2, this program reads 1",
                            "has a 'scene' that is number, not string", "lacks 'effects'"));
    data = good_seams();
    data["cases"] = {json::object(), 5};
    EXPECT_THAT(problems_of(data),
                ElementsAre("case 1 lacks 'name'", "case 1 lacks 'verdict'",
                            "case 1 lacks 'comparison'", "case 2 is number, not an object"));
    data = good_seams();
    data["cases"][0]["comparison"] = {{"identical", "yes"}};
    EXPECT_THAT(problems_of(data),
                ElementsAre("case 1 has a comparison that has a 'identical' that is string, not "
                            "boolean",
                            "case 1 has a comparison that lacks 'differing'"));
    data["cases"][0]["comparison"] = nullptr;
    EXPECT_THAT(problems_of(data),
                ElementsAre("case 1 has a 'comparison' that is null, not object"));
    data["cases"][0]["failure"] = "went up in smoke";
    EXPECT_THAT(problems_of(data), IsEmpty());
}

TEST_F(ReportCommand, TheOtherResultsNeedTheirRows) {
    EXPECT_THAT(problems_of(json::object(), "speedup"), ElementsAre("lacks 'rows'"));
    fs::remove(path("speedup.json"));
    EXPECT_THAT(problems_of(json::object(), "noise"), ElementsAre("lacks 'noise'"));
}

TEST_F(ReportCommand, OfAFailureOnlyTheSceneIsAsked) {
    EXPECT_THAT(problems_of({{"format", "mpipov-seams"},
                             {"version", 1},
                             {"scene", "cube"},
                             {"failure", "Parse Error"}}),
                IsEmpty());
}

TEST_F(ReportCommand, AFileThatCannotBeUsedHasNoData) {
    const std::string deep = std::string(100, '[') + std::string(100, ']');
    for (const auto& [text, said] : std::vector<std::pair<std::string, std::string>>{
             {"", "parse error"},
             {R"({"scene": "cu)", "parse error"},
             {"[1]", "holds array"},
             {R"({"format": "mpipov-run"})", "its format is \"mpipov-run\""},
             {R"({"format": "mpipov-seams", "cases": )" + deep + "}", "nested"},
             {"{\"scene\": \"\xff\"}", "UTF-8"}}) {
        write("seams.json", text);
        const json entry = collect_results(folder_.path()).at("entries").at(0);
        EXPECT_TRUE(entry.at("data").is_null()) << text;
        ASSERT_EQ(entry.at("problems").size(), 1U) << text;
        EXPECT_THAT(entry.at("problems").at(0).get<std::string>(),
                    AllOf(HasSubstr(said), Not(HasSubstr("json.exception"))));
    }
}

TEST_F(ReportCommand, WritesThePage) {
    json data = good_seams();
    data["references"]["default"] = {{"image", "serial.png"}};
    write("one/seams.json", data);
    write("two/seams.json", std::string(R"({"format": )"));
    write_image(path("one/serial.png"), textured(40, 30), TypeDesc::UINT8);
    EXPECT_EQ(run({"."}), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("report.html"));
    EXPECT_THAT(read("report.html"),
                AllOf(HasSubstr("<!DOCTYPE html>"), HasSubstr("case-1"), HasSubstr("parse error"),
                      HasSubstr("data:image/png;base64,"), HasSubstr("</html>")));
    EXPECT_FALSE(fs::exists(path("report.html.part")));
    EXPECT_EQ(run({"one", "--output", "page.html"}), 0) << output_;
    EXPECT_THAT(read("page.html"), Not(HasSubstr("parse error")));
}

TEST_F(ReportCommand, UsageErrors) {
    EXPECT_EQ(run({}), 2);
    EXPECT_THAT(output_, HasSubstr("mpipov-validate: "));
    EXPECT_EQ(run({".", "--nonsense"}), 2);
    EXPECT_EQ(run({"--help"}), 0);
    write("seams.json", good_seams());
    fs::create_hard_link(path("seams.json"), path("other.html"));
    for (const char* output : {"seams.json", "other.html"}) {
        EXPECT_EQ(run({".", "--output", output}), 2) << output;
        EXPECT_THAT(output_, HasSubstr("--output would overwrite"));
    }
    EXPECT_EQ(json::parse(read("seams.json")), good_seams());
}

TEST_F(ReportCommand, FileErrors) {
    EXPECT_EQ(run({"none"}), 4);
    EXPECT_THAT(output_, HasSubstr("cannot read 'none': No such file"));
    EXPECT_EQ(run({"."}), 4);
    EXPECT_THAT(output_, HasSubstr("mpipov-validate seams"));
    EXPECT_FALSE(fs::exists(path("report.html")));
    write("seams.json", good_seams());
    EXPECT_EQ(run({"seams.json"}), 4);
    EXPECT_THAT(output_, HasSubstr("is no folder"));
    EXPECT_EQ(run({".", "--output", "no/page.html"}), 4);
    EXPECT_THAT(output_, HasSubstr("cannot write 'no/page.html'"));
}

}  // namespace
}  // namespace mpipov
