#include "ship_scene.h"

#include "confinement.h"
#include "failure.h"
#include "in_process_transport.h"
#include "received_scene.h"
#include "scratch.h"
#include "worker.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <list>
#include <thread>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

std::string text_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// Rank 0 in the test's own thread, the others in threads of their own, each on a host of its own
// that sees the same files but for what `sees` changes. They end with the test.
class ShipSceneTest : public testing::Test {
  protected:
    static constexpr int ranks = 4;

    void SetUp() override {
        fs::create_directories(home() / "job");
        fs::create_directories(home() / "lib");
        fs::current_path(home() / "job");
        write("scene.pov", "#include \"a.inc\"\nimage_map { png \"map.png\" }");
        write("../lib/a.inc", "#declare A = 1;");
        write("map.png", std::string(2 * max_band_bytes + 17, 'm'));
        request_.scene = {"scene.pov", {"scene.pov", "+L../lib"}, {"../lib"}, "scene.png"};
        request_.arguments = {home() / "job/scene.pov", "+L../lib", "+W40"};
        for (int rank = 0; rank < ranks; ++rank)
            request_.ranks.push_back({fmt::format("host{}", rank), fmt::format("view{}", rank)});
        request_.patience_seconds = 20;
    }
    void TearDown() override {
        stop();
        fs::current_path("/");
    }
    // The other ranks.
    void stop() {
        for (int rank = 1; rank < ranks; ++rank)
            transports_.at(0).send({MessageKind::stop, rank, nlohmann::json::object(), {}});
        for (std::thread& thread : threads_) thread.join();
        threads_.clear();
    }

    fs::path home() const { return scratch_.path() / "home"; }
    static void write(const fs::path& file, const std::string& text) {
        std::ofstream(file) << text;
    }

    Shipping ship() {
        for (int rank = 1; rank < ranks; ++rank)
            threads_.emplace_back([this, rank] { serve(rank); });
        Options options;
        options.povray_arguments = request_.arguments;
        options.confine = confine_;
        options.allow_read = allow_read_;
        const Confinement confinement(options, {}, std::next(folders_.begin(), 0)->path());
        request_.may_go = [&](const fs::path& file) { return confinement.is_users(file); };
        return ship_scene(request_, transports_.at(0));
    }

    // Changes the answer of a rank before rank 0 gets it.
    std::function<void(int rank, SceneView&)> sees_ = [](int, SceneView&) {};
    ShipRequest request_;
    Confining confine_ = Confining::automatic;
    std::vector<fs::path> allow_read_;

  private:
    void serve(int rank) {
        const ScratchFolder& scratch = *std::next(folders_.begin(), rank);
        Worker worker(transports_.at(rank), scratch.path());
        try {
            while (!worker.stopped()) {
                const auto message = transports_.at(rank).try_receive();
                if (!message)
                    std::this_thread::sleep_for(std::chrono::milliseconds(1));
                else if (message->kind == MessageKind::look)
                    answer(rank, *message);
                else
                    worker.handle(*message);
            }
        } catch (const std::exception& error) {
            transports_.at(rank).send(
                {MessageKind::refused, 0, {{"host", "?"}, {"why", error.what()}, {"code", 4}}, {}});
        }
    }
    void answer(int rank, const Message& message) {
        SceneView view = view_scene(scene_request_from_json(message.head));
        sees_(rank, view);
        transports_.at(rank).send({MessageKind::seen, 0, to_json(view), {}});
    }

    const ScratchFolder scratch_{"ship-scene-test"};
    std::list<ScratchFolder> folders_ = [] {
        std::list<ScratchFolder> folders;
        for (int rank = 0; rank < ranks; ++rank) folders.emplace_back("ship-scene-rank");
        return folders;
    }();
    InProcessRanks transports_{ranks};
    std::vector<std::thread> threads_;
};

TEST_F(ShipSceneTest, NobodyIsSentWhatHeSees) {
    const Shipping shipping = ship();
    EXPECT_THAT(shipping.hosts, IsEmpty());
    EXPECT_EQ(shipping.scene.copy_for(1), "");
}

TEST_F(ShipSceneTest, RanksWithTheViewOfRankZeroAreNotEvenAsked) {
    request_.ranks[2].view = request_.ranks[0].view;
    request_.ship = Ship::on;
    sees_ = [](int rank, SceneView&) { EXPECT_NE(rank, 2); };
    const Shipping shipping = ship();
    EXPECT_THAT(shipping.hosts, ElementsAre("host1", "host3"));
    EXPECT_EQ(shipping.scene.copy_for(2), "");
}

TEST_F(ShipSceneTest, WhoLacksAFileIsSentThemAll) {
    sees_ = [](int rank, SceneView& view) {
        if (rank == 2) view.files.erase("map.png");
    };
    const Shipping shipping = ship();
    EXPECT_THAT(shipping.hosts, ElementsAre("host2"));
    EXPECT_EQ(shipping.files, 4U);
    EXPECT_EQ(shipping.scene.copy_for(1), "");
    const fs::path copy = shipping.scene.copy_for(2);
    EXPECT_EQ(text_of(copy / "scene/job/map.png"), text_of("map.png"));
    EXPECT_EQ(text_of(copy / "scene/job/scene.pov"), text_of("scene.pov"));
    EXPECT_EQ(text_of(copy / "scene/lib/a.inc"), text_of("../lib/a.inc"));
    EXPECT_EQ(shipping.scene.folder, "scene/job");
    EXPECT_TRUE(fs::exists(copy / shipping.scene.ini));
    EXPECT_THAT(shipping.scene.arguments, ElementsAre("scene.pov", "+L../lib", "+W40"));
}

TEST_F(ShipSceneTest, RanksOfOneViewShareACopy) {
    request_.ranks[3].view = request_.ranks[1].view;
    request_.ranks[3].host = request_.ranks[1].host;
    request_.ship = Ship::on;
    const Shipping shipping = ship();
    EXPECT_THAT(shipping.hosts, ElementsAre("host1", "host2"));
    EXPECT_EQ(shipping.scene.copy_for(1), shipping.scene.copy_for(3));
    EXPECT_NE(shipping.scene.copy_for(1), shipping.scene.copy_for(2));
}

TEST_F(ShipSceneTest, AViewThatIsNotKnownIsLikeNoOther) {
    for (ShipRequest::Rank& rank : request_.ranks) rank.view.clear();
    request_.ship = Ship::on;
    EXPECT_THAT(ship().hosts, ElementsAre("host1", "host2", "host3"));
}

TEST_F(ShipSceneTest, AnotherFileOneMoreAndAnotherIniCountAsMissing) {
    sees_ = [](int rank, SceneView& view) {
        if (rank == 1) view.files["scene.pov"] = "other";
        if (rank == 2) view.files["a.inc"] = "would come before that of the library";
        if (rank == 3) view.ini_sha1 = "other";
    };
    EXPECT_THAT(ship().hosts, ElementsAre("host1", "host2", "host3"));
}

TEST_F(ShipSceneTest, OffRefusesWithTheHostAndTheFile) {
    request_.ship = Ship::off;
    sees_ = [](int rank, SceneView& view) {
        if (rank == 3) view.files.erase("map.png");
    };
    EXPECT_THAT([&] { ship(); },
                ThrowsMessage<Failure>(HasSubstr("host host3 lacks 'map.png': leave --ship off")));
}

TEST_F(ShipSceneTest, AnAbsoluteNameInTheTextMustLeadToTheSameFile) {
    const std::string name = home() / "absolute.inc";
    write(name, "#declare B = 2;");
    write("scene.pov", "#include \"" + name + "\"");
    request_.ship = Ship::on;
    // Not sent, and not needed.
    const Shipping shipping = ship();
    EXPECT_EQ(shipping.files, 2U);
    EXPECT_EQ(shipping.hosts.size(), 3U);
}

TEST_F(ShipSceneTest, AnAbsoluteNameThatLeadsToAnotherFileIsRefused) {
    const std::string name = home() / "absolute.inc";
    write(name, "#declare B = 2;");
    write("scene.pov", "#include \"" + name + "\"");
    sees_ = [&](int rank, SceneView& view) {
        if (rank == 2) view.files[name] = "other";
    };
    EXPECT_THAT([&] { ship(); },
                ThrowsMessage<Failure>(AllOf(HasSubstr("host host2 has another '" + name),
                                             HasSubstr("relative to the scene"))));
}

TEST_F(ShipSceneTest, WhatLiesOutsideIsNotSent) {
    request_.ship = Ship::on;
    write(home() / "key.inc", "secret");
    write("scene.pov", "#include \"../key.inc\"");
    EXPECT_THAT([&] { ship(); },
                ThrowsMessage<Failure>(HasSubstr("'../key.inc', which the scene names, is not")));
}

TEST_F(ShipSceneTest, ALinkThatLeadsOutIsNotSent) {
    request_.ship = Ship::on;
    write(home() / "key", "secret");
    fs::remove("map.png");
    fs::create_symlink(home() / "key", "map.png");
    EXPECT_THAT([&] { ship(); }, ThrowsMessage<Failure>(HasSubstr("'map.png', which the scene")));
}

TEST_F(ShipSceneTest, ALinkThatStaysInsideIsSentAsTheFileItLeadsTo) {
    request_.ship = Ship::on;
    fs::rename("map.png", "real.png");
    fs::create_symlink("real.png", "map.png");
    const fs::path copy = ship().scene.copy_for(1);
    EXPECT_FALSE(fs::is_symlink(copy / "scene/job/map.png"));
    EXPECT_EQ(text_of(copy / "scene/job/map.png"), text_of("real.png"));
}

// An INI file beside the scene is the scene's: it opens no folder for it to be read, nor to be
// sent.
TEST_F(ShipSceneTest, AnIniFileOfTheScenesOpensNoFolder) {
    request_.ship = Ship::on;
    fs::create_directories(home() / "keys");
    write(home() / "keys/key.inc", "secret");
    write("job.ini", "Library_Path=" + (home() / "keys").string() + "\n");
    write("scene.pov", "#include \"key.inc\"");
    request_.scene.options = {"scene.pov", "job.ini"};
    request_.scene.library_paths = {home() / "keys"};
    request_.arguments = {"scene.pov", "job.ini"};
    for (const Confining confine : {Confining::automatic, Confining::off}) {
        confine_ = confine;
        EXPECT_THAT([&] { ship(); }, ThrowsMessage<Failure>(
                                         AllOf(HasSubstr("key.inc', which the scene names, is not"),
                                               HasSubstr("--allow-read"))));
        stop();
    }
    allow_read_ = {home() / "keys"};  // the way out
    EXPECT_EQ(text_of(ship().scene.copy_for(1) / "scene/keys/key.inc"), "secret");
}

TEST_F(ShipSceneTest, ADeviceIsNoFileOfAScene) {
    request_.ship = Ship::on;
    fs::remove("map.png");
    fs::create_symlink("/dev/zero", "map.png");
    EXPECT_EQ(ship().files, 3U);
}

TEST_F(ShipSceneTest, AnIniFileArrivesWithRelativeNames) {
    request_.ship = Ship::on;
    write("job.ini", "Library_Path=" + (home() / "lib").string() + "\nWidth=40\n");
    request_.scene.options = {"job.ini"};
    request_.scene.library_paths = {home() / "lib"};
    request_.arguments = {"job.ini"};
    allow_read_ = {home() / "lib"};
    const fs::path copy = ship().scene.copy_for(1);
    EXPECT_EQ(text_of(copy / "scene/job/job.ini"), "Library_Path=../lib\nWidth=40\n");
    EXPECT_EQ(text_of(copy / "scene/lib/a.inc"), text_of("../lib/a.inc"));
}

TEST_F(ShipSceneTest, ARankThatCannotUnpackIsNamed) {
    request_.ship = Ship::on;
    sees_ = [&](int rank, SceneView&) {
        if (rank == 2) throw std::runtime_error("no space here");
    };
    EXPECT_THAT([&] { ship(); }, ThrowsMessage<Failure>(HasSubstr("host host2: no space here")));
}

}  // namespace
}  // namespace mpipov
