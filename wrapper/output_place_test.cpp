#include "output_place.h"

#include "failure.h"
#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class OutputPlaceTest : public testing::Test {
  protected:
    static void write(const fs::path& file, const std::string& text) {
        std::ofstream out(file);
        out << text;
        if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
    }
    static std::string read(const fs::path& file) {
        std::ifstream in(file);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder()))
            names.push_back(entry.path().filename());
        return names;
    }
    const fs::path& folder() const { return scratch_.path(); }

    static void expect_refused(const OutputPlace& place, const std::string& why) {
        try {
            place.check();
            FAIL() << "accepted " << place.image();
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), Exit::file);
            EXPECT_THAT(failure.what(), HasSubstr(why));
        }
    }

  private:
    ScratchFolder scratch_{"output-place-test"};
};

TEST_F(OutputPlaceTest, EverythingLiesBesideTheImage) {
    const OutputPlace place(folder() / "picture.png", {}, {});
    EXPECT_EQ(place.image(), folder() / "picture.png");
    EXPECT_EQ(place.record(), folder() / "run.json");
    EXPECT_EQ(place.work_folder(), folder() / "picture.png.mpipov");
}

TEST_F(OutputPlaceTest, ABareNameMeansTheCurrentFolder) {
    const OutputPlace place("picture.png", {}, {});
    EXPECT_EQ(place.record(), "run.json");
    EXPECT_EQ(place.work_folder(), "picture.png.mpipov");
}

// A pipe of the test's own stands for /dev/null, beside which no other file belongs.
TEST_F(OutputPlaceTest, NothingLiesBesideAPipe) {
    const fs::path pipe = folder() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const OutputPlace place(pipe, {}, {});
    EXPECT_EQ(place.record(), "run.json");
    EXPECT_EQ(place.work_folder(), "pipe.mpipov");
    OutputPlace(pipe, pipe, folder() / "work").check();
    EXPECT_THAT(files(), ElementsAre("pipe"));
    EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(OutputPlaceTest, GivenNamesAreKept) {
    const OutputPlace place("a/picture.png", "b/record.json", "c");
    EXPECT_EQ(place.record(), "b/record.json");
    EXPECT_EQ(place.work_folder(), "c");
}

TEST_F(OutputPlaceTest, ALongNameHasRoomForEverything) {
    const std::string name = std::string(251, 'n') + ".png";
    const OutputPlace place(folder() / name, {}, {});
    place.check();
    EXPECT_LE(place.work_folder().filename().string().size(), 255u);
    fs::create_directory(place.work_folder());
    fs::remove(place.work_folder());
    place.write([&](const fs::path& part) { write(part, "new"); });
    EXPECT_THAT(files(), ElementsAre(name));
    expect_refused({folder() / ("n" + name), folder() / "run.json", {}}, "too long");
}

TEST_F(OutputPlaceTest, TheImageHasTheRightsOfANewFile) {
    const OutputPlace place(folder() / "picture.png", {}, {});
    place.write([&](const fs::path& part) { write(part, "new"); });
    write(folder() / "other", "");
    EXPECT_EQ(fs::status(place.image()).permissions(),
              fs::status(folder() / "other").permissions());
}

TEST_F(OutputPlaceTest, AGoodPlaceIsAcceptedAndLeftAsItWas) {
    write(folder() / "picture.png", "old");
    OutputPlace(folder() / "picture.png", {}, {}).check();
    EXPECT_THAT(files(), ElementsAre("picture.png"));
    EXPECT_EQ(read(folder() / "picture.png"), "old");
}

TEST_F(OutputPlaceTest, ABadPlaceIsRefusedBeforehand) {
    const fs::path missing = folder() / "missing";
    expect_refused({missing / "picture.png", {}, {}}, missing.string());
    expect_refused({folder() / "picture.png", missing / "run.json", {}}, "run.json");
    expect_refused({folder(), folder() / "run.json", {}}, "directory");
    expect_refused({"/proc/picture.png", folder() / "run.json", {}}, "/proc/picture.png");
    write(folder() / "file", "");
    expect_refused({folder() / "file" / "picture.png", folder() / "run.json", {}}, "picture.png");
}

TEST_F(OutputPlaceTest, WritesBesideAndRenames) {
    const OutputPlace place(folder() / "picture.png", {}, {});
    write(place.image(), "old");
    place.write([&](const fs::path& part) {
        EXPECT_EQ(part.parent_path(), folder());
        EXPECT_NE(part, place.image());
        EXPECT_EQ(part.filename().string().front(), '.');
        EXPECT_EQ(read(place.image()), "old") << "the old image is there until the new one is";
        write(part, "new");
    });
    EXPECT_EQ(read(place.image()), "new");
    EXPECT_THAT(files(), ElementsAre("picture.png"));
}

TEST_F(OutputPlaceTest, AFailureLeavesTheOldImageAndNothingElse) {
    const OutputPlace place(folder() / "picture.png", {}, {});
    write(place.image(), "old");
    try {
        place.write([&](const fs::path& part) {
            write(part, "half");
            throw std::runtime_error("the disk is full");
        });
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::file);
        EXPECT_THAT(failure.what(), HasSubstr("the disk is full"));
    }
    EXPECT_EQ(read(place.image()), "old");
    EXPECT_THAT(files(), ElementsAre("picture.png"));
}

TEST_F(OutputPlaceTest, WhateverIsThrownNothingIsLeft) {
    const OutputPlace place(folder() / "picture.png", {}, {});
    EXPECT_ANY_THROW(place.write([&](const fs::path& part) {
        write(part, "half");
        throw std::bad_alloc();
    }));
    EXPECT_THAT(files(), IsEmpty());
}

TEST_F(OutputPlaceTest, AFolderInTheWayIsNamed) {
    const OutputPlace place(folder() / "picture.png", {}, {});
    fs::create_directories(place.image() / "inside");
    try {
        place.write([&](const fs::path& part) { write(part, "new"); });
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), Exit::file);
        EXPECT_THAT(failure.what(), HasSubstr("picture.png"));
    }
    EXPECT_THAT(files(), ElementsAre("picture.png"));
}

}  // namespace
}  // namespace mpipov
