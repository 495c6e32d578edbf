#include "worker.h"

#include "fake_povray_test_support.h"
#include "image_test_support.h"
#include "in_process_transport.h"
#include "known_picture.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mpipov {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Ge;
using testing::HasSubstr;
using testing::Le;

constexpr ImageSize image{64, 48};
// Several bands.
constexpr ImageSize large{1300, 1300};
constexpr std::size_t large_bytes = std::size_t{1300} * 1300 * known_channels;
static_assert(large_bytes > 3 * max_band_bytes);

// A worker on rank 1; the test is its coordinator.
class WorkerTest : public FakePovrayTest {
  protected:
    // A launch that has done its work may be leaving still.
    void TearDown() override {
        worker_.handle({MessageKind::stop, 1, nlohmann::json::object(), {}});
        FakePovrayTest::TearDown();
    }

    static nlohmann::json job_head(const ImageSize& size = image) {
        JobCommand job = fake_job(size);
        return {{"povray", job.povray},
                {"user_arguments", job.user_arguments},
                {"format_arguments", job.format_arguments},
                {"threads", 1},
                {"block", 0},
                {"width", size.width},
                {"height", size.height},
                {"gathers", false},
                {"cache_bytes", 0},
                {"copy", ""},
                {"folder", ""},
                {"ini", ""},
                {"timeout_seconds", 30}};
    }

    void send_job(const ImageSize& size = image, std::optional<double> timeout = 30,
                  const std::string& povray = MPIPOV_FAKE_POVRAY) {
        nlohmann::json head = job_head(size);
        head["povray"] = povray;
        head["timeout_seconds"] = timeout ? nlohmann::json(*timeout) : nlohmann::json();
        worker_.handle({MessageKind::job, 1, head, {}});
    }

    // The worker reads `cache`, in pieces, or none where it is empty.
    void send_gathering_job(const std::string& cache, const ImageSize& size = image) {
        nlohmann::json head = job_head(size);
        head["gathers"] = true;
        head["cache_bytes"] = cache.size();
        worker_.handle({MessageKind::job, 1, head, {}});
        for (std::size_t at = 0; at < cache.size(); at += 7) send_cache(cache.substr(at, 7));
    }

    void send_cache(const std::string& text) {
        const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
        worker_.handle(
            {MessageKind::cache, 1, nlohmann::json::object(), {bytes, bytes + text.size()}});
    }

    void assign(int section, const Rect& render, int attempt = 1) {
        worker_.handle({MessageKind::assign,
                        1,
                        {{"section", section},
                         {"attempt", attempt},
                         {"keep", rect_to_json(render)},
                         {"render", rect_to_json(render)}},
                        {}});
    }

    void look_after(double seconds_left) {
        if (worker_.step()) return;
        std::vector<pollfd> fds;
        worker_.add_poll_fds(fds);
        ::poll(fds.data(), fds.size(),
               worker_.wait_milliseconds(std::max(1, static_cast<int>(seconds_left * 1000))));
    }

    // What the worker says until it has said `ends` times that a section is done or failed.
    std::vector<Message> listen(int ends = 1, double patience_seconds = 60) {
        std::vector<Message> heard;
        const auto begin = std::chrono::steady_clock::now();
        while (ends > 0) {
            const double left = patience_seconds - seconds_since(begin);
            if (left <= 0) throw std::runtime_error("the worker says nothing");
            look_after(std::min(left, 0.01));
            while (auto message = ranks_.at(0).try_receive()) {
                ends -= message->kind == MessageKind::done || message->kind == MessageKind::failed;
                heard.push_back(std::move(*message));
            }
        }
        return heard;
    }

    // A section is done before its POV-Ray has ended.
    void wait_until_launches_have_left() {
        const auto begin = std::chrono::steady_clock::now();
        while (files_left() > 0 && seconds_since(begin) < 30) look_after(0.01);
    }

    std::string failure_of(int section = 0) {
        assign(section, {0, 0, 32, 48});
        const std::vector<Message> heard = listen();
        EXPECT_EQ(heard.back().kind, MessageKind::failed);
        EXPECT_EQ(heard.back().head.at("section"), section);
        EXPECT_GE(heard.back().head.at("cpu_seconds").get<double>(), 0);
        return heard.back().head.value("why", "");
    }

    static double seconds_since(std::chrono::steady_clock::time_point begin) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }

    InProcessRanks ranks_{2};
    Worker worker_{ranks_.at(1), scratch_.path()};
};

std::vector<Message> of_kind(const std::vector<Message>& all, MessageKind kind) {
    std::vector<Message> some;
    for (const Message& message : all)
        if (message.kind == kind) some.push_back(message);
    return some;
}

// The bands are whole rows in order, cover the section, and hold the known picture.
void expect_known_bands(const std::vector<Message>& bands, const Rect& render) {
    int row = render.y0;
    for (const Message& band : bands) {
        const Rect rect = rect_from_json(band.head.at("rect"));
        EXPECT_EQ(rect.x0, render.x0);
        EXPECT_EQ(rect.x1, render.x1);
        EXPECT_EQ(rect.y0, row);
        EXPECT_LE(band.body.size(), max_band_bytes);
        EXPECT_TRUE(band.body == known_pixels(rect)) << "wrong pixels from row " << rect.y0;
        row = rect.y1;
    }
    EXPECT_EQ(row, render.y1);
}

TEST_F(WorkerTest, ALaunchThatIsTakenOverCanHang) {
    const Environment hanging = faults("hang");
    send_job(image, 0.05);
    LaunchFolder folder(scratch_.path() / "early");
    ChildRequest request;
    request.argv = {MPIPOV_FAKE_POVRAY};
    worker_.adopt(0, {std::move(folder), ChildProcess::start(request)});
    EXPECT_THAT(failure_of(), HasSubstr("did not end within"));
}

// POV-Ray sleeps for 0.3 s then, and the stand-in for ever.
TEST_F(WorkerTest, DoesNotWaitForAPovrayThatHasDoneItsWork) {
    const Environment lingering = faults("linger");
    send_job();
    for (const int section : {0, 1}) {
        assign(section, {0, 0, 64, 48});
        const std::vector<Message> heard = listen();
        expect_known_bands(of_kind(heard, MessageKind::band), {0, 0, 64, 48});
        EXPECT_EQ(heard.back().kind, MessageKind::done);
        EXPECT_GT(heard.back().head.at("wall_seconds").get<double>(), 0);
        EXPECT_GT(heard.back().head.at("cpu_seconds").get<double>(), 0);
    }
    EXPECT_EQ(files_left(), 2) << "nothing of a process that runs is taken from it";
    worker_.stop();
}

TEST_F(WorkerTest, RefusesSizesThatCannotBe) {
    for (const char* key : {"width", "height", "threads"})
        for (const nlohmann::json& bad : {nlohmann::json(0), nlohmann::json(-5),
                                          nlohmann::json(1LL << 40), nlohmann::json(1e300)}) {
            nlohmann::json head = job_head(image);
            head[key] = bad;
            EXPECT_THROW(worker_.handle({MessageKind::job, 1, head, {}}), std::runtime_error)
                << key << ' ' << bad;
        }
    send_job();
    for (const Rect& bad : {Rect{0, 0, 65, 48}, Rect{0, 0, 64, 1 << 29}, Rect{-1, 0, 64, 48},
                            Rect{8, 0, 8, 48}, Rect{9, 0, 8, 48}})
        EXPECT_THROW(assign(0, bad), std::runtime_error);
    EXPECT_EQ(files_left(), 0);
}

TEST_F(WorkerTest, PovraysOwnWordsComeBeforeOurs) {
    const Environment full_disk = faults("late-error");
    send_job();
    EXPECT_THAT(failure_of(), HasSubstr("No space left"));
}

TEST_F(WorkerTest, SendsThePixelsOfTheSectionAndThenItsTimes) {
    send_job();
    int id = 0;
    for (const Rect& render : {Rect{0, 0, 64, 48}, Rect{7, 5, 30, 41}, Rect{0, 0, 1, 48},
                               Rect{0, 0, 64, 1}, Rect{63, 47, 64, 48}, Rect{0, 0, 1, 1}}) {
        assign(id, render, 3);
        const std::vector<Message> heard = listen();
        expect_known_bands(of_kind(heard, MessageKind::band), render);
        for (const Message& message : heard) {
            EXPECT_EQ(message.peer, 1);
            EXPECT_EQ(message.head.at("section"), id);
            EXPECT_EQ(message.head.at("attempt"), 3);
        }
        const Message& done = heard.back();
        EXPECT_EQ(done.kind, MessageKind::done);
        EXPECT_GT(done.head.at("wall_seconds").get<double>(), 0);
        EXPECT_GE(done.head.at("cpu_seconds").get<double>(), 0);
        EXPECT_THAT(done.head.at("warnings").get<std::vector<std::string>>(),
                    ElementsAre(HasSubstr("a warning of the stand-in")));
        wait_until_launches_have_left();
        EXPECT_EQ(files_left(), 0);
        ++id;
    }
}

TEST_F(WorkerTest, SendsALargeSectionInBandsAndWaitsForThemToLeave) {
    send_job(large);
    assign(0, {0, 0, large.width, large.height});
    const auto begin = std::chrono::steady_clock::now();
    while (ranks_.waiting() < 2 && seconds_since(begin) < 60) look_after(0.01);
    for (int i = 0; i < 10; ++i) EXPECT_FALSE(worker_.step()) << "nobody takes the bands";
    EXPECT_EQ(ranks_.waiting(), 2u);
    EXPECT_EQ(worker_.wait_milliseconds(1000), 1) << "it must look again soon";
    const std::vector<Message> heard = listen();
    const std::vector<Message> bands = of_kind(heard, MessageKind::band);
    EXPECT_GE(bands.size(), large_bytes / max_band_bytes);
    expect_known_bands(bands, {0, 0, large.width, large.height});
    EXPECT_EQ(heard.back().kind, MessageKind::done);
}

TEST_F(WorkerTest, ReportsProgressInSteps) {
    const Environment slow = faults("slow");
    send_job();
    assign(0, {0, 0, 64, 48});
    double last = 0;
    int reports = 0;
    for (const Message& message : of_kind(listen(), MessageKind::progress)) {
        const double fraction = message.head.at("fraction");
        EXPECT_THAT(fraction, AllOf(Ge(last + 0.02), Le(1)));
        last = fraction;
        ++reports;
    }
    EXPECT_GT(reports, 2);
    EXPECT_GT(last, 0.5);
}

TEST_F(WorkerTest, KeepsSeveralLaunchesUnderWay) {
    const Environment slow = faults("slow");
    send_job();
    for (int id = 0; id < 4; ++id) assign(id, {id * 16, 0, id * 16 + 16, 48});
    std::set<int> seen;
    std::size_t seen_before_first_end = 0;
    const std::vector<Message> heard = listen(4);
    for (const Message& message : heard) {
        seen.insert(message.head.at("section").get<int>());
        if (message.kind == MessageKind::done && seen_before_first_end == 0)
            seen_before_first_end = seen.size();
    }
    EXPECT_EQ(seen_before_first_end, 4u) << "they ran one after the other";
    for (int id = 0; id < 4; ++id) {
        std::vector<Message> bands;
        for (const Message& message : of_kind(heard, MessageKind::band))
            if (message.head.at("section") == id) bands.push_back(message);
        expect_known_bands(bands, {id * 16, 0, id * 16 + 16, 48});
    }
}

TEST_F(WorkerTest, SaysWhyALaunchFailedAndGoesOn) {
    send_job();
    {
        const Environment fault = faults("error");
        EXPECT_THAT(failure_of(), HasSubstr("Parse Error: Undeclared identifier 'Sphere'"));
    }
    {
        const Environment fault = faults("crash");
        EXPECT_THAT(failure_of(), AllOf(HasSubstr("signal 11"), HasSubstr("SIGSEGV")));
    }
    {
        const Environment fault = faults("no-file");
        EXPECT_THAT(failure_of(), HasSubstr("wrote no image"));
    }
    {
        const Environment fault = faults("truncated");
        EXPECT_THAT(failure_of(), HasSubstr("truncated"));
    }
    {
        const Environment fault = faults("wrong-size");
        EXPECT_THAT(failure_of(), AllOf(HasSubstr("64x49"), HasSubstr("64x48")));
    }
    EXPECT_EQ(files_left(), 0);
    assign(9, {0, 0, 32, 48});
    EXPECT_EQ(listen().back().kind, MessageKind::done);
}

TEST_F(WorkerTest, EndsALaunchWhoseTimeIsUp) {
    const Environment fault = faults("hang");
    send_job(image, 0.3);
    EXPECT_THAT(failure_of(), HasSubstr("did not end within 0.3 s (--timeout)"));
}

TEST_F(WorkerTest, NoticesDamageThatShowsOnlyInLaterRows) {
    const std::filesystem::path whole = elsewhere_.path() / "whole.png";
    write_pattern(whole, {large.width, large.height, 3, Depth::uint8}, "png");
    std::filesystem::resize_file(whole, std::filesystem::file_size(whole) * 3 / 4);
    const Environment fault("FAKE_POVRAY", "copy"), file("FAKE_POVRAY_COPY", whole.string());
    send_job(large);
    assign(0, {0, 0, large.width, large.height});
    const std::vector<Message> heard = listen();
    EXPECT_GT(of_kind(heard, MessageKind::band).size(), 0u) << "the first rows were in order";
    EXPECT_EQ(heard.back().kind, MessageKind::failed);
    EXPECT_THAT(heard.back().head.value("why", ""), HasSubstr("truncated or damaged"));
}

TEST_F(WorkerTest, SaysThatTheProgramCannotBeStarted) {
    send_job(image, 30, "/nowhere/povray");
    EXPECT_THAT(failure_of(), HasSubstr("/nowhere/povray"));
}

TEST_F(WorkerTest, SaysThatItsGuardIsMissing) {
    const Environment no_guard("MPIPOV_GUARD", "/nowhere/guard");
    send_job();
    EXPECT_THAT(failure_of(), HasSubstr("/nowhere/guard"));
}

const std::string common_sample = "C1\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\n";

std::string text_of(const std::vector<Message>& pieces) {
    std::string text;
    for (const Message& piece : pieces)
        text.append(reinterpret_cast<const char*>(piece.body.data()), piece.body.size());
    return text;
}

TEST_F(WorkerTest, GathersSamples) {
    send_gathering_job("");
    assign(4, {16, 0, 48, 24}, 2);
    const std::vector<Message> heard = listen();
    EXPECT_EQ(heard.back().kind, MessageKind::done);
    EXPECT_THAT(of_kind(heard, MessageKind::band), testing::IsEmpty());
    EXPECT_EQ(text_of(of_kind(heard, MessageKind::samples)),
              common_sample + "C2\t16\t0\t48\t24\t0\t0\t0\t0\t0\t0\n");
    EXPECT_EQ(heard.back().head.at("section"), 4);
    EXPECT_EQ(heard.back().head.at("attempt"), 2);
}

// The next job, of an image or of another wave, must not find what an earlier one left.
TEST_F(WorkerTest, SendsOnlyTheSamplesThatWereNotThere) {
    const std::string known = common_sample + common_sample + common_sample;
    for (int round = 0; round < 2; ++round) {
        send_gathering_job(known);
        assign(0, {0, 0, 32, 48});
        EXPECT_EQ(text_of(of_kind(listen(), MessageKind::samples)),
                  common_sample + "C2\t0\t0\t32\t48\t3\t0\t0\t0\t0\t0\n");
    }
    send_gathering_job("");
    assign(0, {0, 0, 32, 48});
    EXPECT_THAT(text_of(of_kind(listen(), MessageKind::samples)), HasSubstr("\t48\t0\t0"));
    std::filesystem::remove(scratch_.path() / "radiosity.cache");
}

// POV-Ray sleeps before it ends, and the next wave has sections of the same numbers.
TEST_F(WorkerTest, ANextJobDoesNotWaitForTheLaunchesOfTheLastOne) {
    const Environment lingering = faults("linger");
    for (int round = 0; round < 2; ++round) {
        send_gathering_job("");
        assign(0, {0, 0, 32, 48});
        EXPECT_EQ(listen().back().kind, MessageKind::done) << round;
    }
    worker_.stop();
}

TEST_F(WorkerTest, RendersPixelsWithTheCacheOfTheJob) {
    nlohmann::json head = job_head();
    head["cache_bytes"] = common_sample.size();
    worker_.handle({MessageKind::job, 1, head, {}});
    send_cache(common_sample);
    assign(0, {0, 0, 32, 48});
    const std::vector<Message> heard = listen();
    EXPECT_EQ(heard.back().kind, MessageKind::done);
    expect_known_bands(of_kind(heard, MessageKind::band), {0, 0, 32, 48});
    std::filesystem::remove(scratch_.path() / "radiosity.cache");
}

TEST_F(WorkerTest, NothingLitIsNoSamples) {
    const Environment fault = faults("no-file");
    send_gathering_job("");
    assign(0, {0, 0, 32, 48});
    const std::vector<Message> heard = listen();
    EXPECT_EQ(heard.back().kind, MessageKind::done);
    EXPECT_THAT(of_kind(heard, MessageKind::samples), testing::IsEmpty());
}

// A full disk: POV-Ray saves what fits, and exits with 0.
TEST_F(WorkerTest, FewerSamplesThanPovrayTookAreNotTaken) {
    for (const std::string fault : {"few-samples", "half-a-sample"}) {
        const Environment few = faults(fault);
        send_gathering_job("");
        assign(0, {0, 0, 32, 48});
        const std::vector<Message> heard = listen();
        EXPECT_EQ(heard.back().kind, MessageKind::failed) << fault;
        EXPECT_THAT(heard.back().head.at("why").get<std::string>(), HasSubstr("space left"));
        EXPECT_EQ(heard.back().head.at("code"), static_cast<int>(Exit::file));
        EXPECT_THAT(of_kind(heard, MessageKind::samples), testing::IsEmpty());
    }
}

TEST_F(WorkerTest, SaysWhyGatheringFailed) {
    const Environment fault = faults("error");
    send_gathering_job("");
    EXPECT_THAT(failure_of(), HasSubstr("Undeclared identifier"));
}

TEST_F(WorkerTest, ACacheIsAsLongAsWasSaid) {
    nlohmann::json head = job_head();
    head["cache_bytes"] = 5;
    worker_.handle({MessageKind::job, 1, head, {}});
    EXPECT_THROW(send_cache("123456"), std::runtime_error);
    EXPECT_THROW(assign(0, {0, 0, 32, 48}), std::runtime_error);
    send_job();
    EXPECT_THROW(send_cache("1"), std::runtime_error);
    std::filesystem::remove(scratch_.path() / "radiosity.cache");
}

TEST_F(WorkerTest, StopLeavesNoProcessAndNoFile) {
    const Environment fault = faults("hang");
    send_job();
    for (int id = 0; id < 3; ++id) assign(id, {id * 16, 0, id * 16 + 16, 48});
    look_after(0.05);
    EXPECT_EQ(files_left(), 3);
    EXPECT_FALSE(worker_.stopped());
    const auto begin = std::chrono::steady_clock::now();
    worker_.handle({MessageKind::stop, 1, nlohmann::json::object(), {}});
    EXPECT_TRUE(worker_.stopped());
    EXPECT_LT(seconds_since(begin), 4) << "it waited for a process that it should have killed";
    EXPECT_FALSE(worker_.step());  // TearDown looks for processes and files
}

TEST_F(WorkerTest, RefusesWhatIsNotForWorkers) {
    for (const MessageKind kind : {MessageKind::hello, MessageKind::band, MessageKind::done,
                                   MessageKind::failed, MessageKind::bye})
        EXPECT_THROW(worker_.handle({kind, 1, nlohmann::json::object(), {}}), std::runtime_error);
}

TEST_F(WorkerTest, SleepsAsLongAsItMayWithoutLaunches) {
    EXPECT_EQ(worker_.wait_milliseconds(777), 777);
    std::vector<pollfd> fds;
    worker_.add_poll_fds(fds);
    EXPECT_TRUE(fds.empty());
    EXPECT_FALSE(worker_.step());
}

TEST_F(WorkerTest, FindsTheImageBesideItsState) {
    const auto base = elsewhere_.path() / "section";
    EXPECT_THROW(find_image(base), std::runtime_error);
    write_text(elsewhere_.path() / "section.pov-state", "");
    write_text(elsewhere_.path() / "all.txt", "a text stream (+GAall.txt)");
    EXPECT_THROW(find_image(base), std::runtime_error);
    write_text(elsewhere_.path() / "section.png", "");
    EXPECT_EQ(find_image(base), elsewhere_.path() / "section.png");
    write_text(elsewhere_.path() / "frame07.png", "");
    EXPECT_EQ(find_image(elsewhere_.path() / "frame"), elsewhere_.path() / "frame07.png");
    EXPECT_THROW(find_image(elsewhere_.path() / "fra"), std::runtime_error);
}

}  // namespace
}  // namespace mpipov
