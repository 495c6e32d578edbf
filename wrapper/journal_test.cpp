#include "journal.h"

#include "failure.h"
#include "scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const json identity{{"scene", "0123abcd"}, {"arguments", {"a.pov", "+W64"}}};
const json plan{{"grid", {{"sections", 4}}}};
constexpr Rect render{0, 0, 4, 6};

// 24 bytes of one channel, six rows of four pixels.
std::vector<std::byte> pixels_of(int section) {
    std::vector<std::byte> pixels(24);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = static_cast<std::byte>(i * 5 + static_cast<std::size_t>(section) * 31);
    return pixels;
}

class JournalTest : public testing::Test {
  protected:
    const fs::path& folder() const { return folder_; }

    static void take_all(Journal& journal, int section) {
        const std::vector<std::byte> pixels = pixels_of(section);
        const std::span<const std::byte> rows(pixels);
        journal.take(section, render, {0, 0, 4, 2}, rows.first(8));
        journal.take(section, render, {0, 2, 4, 6}, rows.subspan(8));
    }
    static void add(Journal& journal, int section) {
        take_all(journal, section);
        journal.finish(section, {{"rank", section * 10}});
    }
    static std::optional<std::uintmax_t> section_bytes(int section) {
        return section < 7 ? std::optional<std::uintmax_t>(24) : std::nullopt;
    }
    // A journal of sections 0, 1 and 2 that an earlier run left.
    void leave_three() const {
        Journal journal = Journal::create(folder(), identity, plan);
        for (int section = 0; section < 3; ++section) add(journal, section);
    }
    static std::vector<int> ids(const Journal& journal) {
        std::vector<int> found;
        for (const Journal::Finished& finished : journal.finished(section_bytes))
            found.push_back(finished.section);
        return found;
    }
    static std::string read(const fs::path& file) {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    static void write(const fs::path& file, const std::string& text) {
        std::ofstream(file, std::ios::binary) << text;
    }
    static void expect_failure(Exit code, const std::string& text,
                               const std::function<void()>& action) {
        try {
            action();
            FAIL() << "nothing was thrown";
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), code);
            EXPECT_THAT(failure.what(), HasSubstr(text));
        }
    }

  private:
    ScratchFolder scratch_{"journal-test"};
    fs::path folder_ = scratch_.path() / "picture.png.mpipov";
};

TEST_F(JournalTest, GivesBackWhatWasFinished) {
    leave_three();
    const Journal journal = Journal::open(folder(), identity);
    EXPECT_EQ(journal.plan(), plan);
    const auto finished = journal.finished(section_bytes);
    ASSERT_EQ(finished.size(), 3u);
    for (int section = 0; section < 3; ++section) {
        const auto i = static_cast<std::size_t>(section);
        EXPECT_EQ(finished[i].section, section);
        EXPECT_EQ(finished[i].about, json({{"rank", section * 10}}));
        EXPECT_EQ(journal.read(section), pixels_of(section));
    }
}

TEST_F(JournalTest, BelongsToOneRunAtATime) {
    const auto refusal = [&](auto&& take) -> std::string {
        try {
            take();
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), Exit::usage);
            return failure.what();
        }
        return {};
    };
    {
        Journal running = Journal::create(folder(), identity, plan);
        add(running, 0);
        EXPECT_THAT(refusal([&] {
                        Journal::create(folder(), {{"scene", "other"}}, plan);
                    }),
                    HasSubstr("in use by another run"));
        EXPECT_THAT(refusal([&] { Journal::open(folder(), identity); }), HasSubstr("--work-dir"));
        add(running, 1);
    }
    EXPECT_THAT(ids(Journal::open(folder(), identity)), ElementsAre(0, 1));
    EXPECT_EQ(refusal([&] { Journal::create(folder(), {{"scene", "other"}}, plan); }), "");
}

TEST_F(JournalTest, SectionsMayComeInterleaved) {
    {
        Journal journal = Journal::create(folder(), identity, plan);
        const auto a = pixels_of(0), b = pixels_of(1);
        journal.take(0, render, {0, 0, 4, 3}, std::span(a).first(12));
        journal.take(1, render, {0, 0, 4, 3}, std::span(b).first(12));
        journal.take(1, render, {0, 3, 4, 6}, std::span(b).subspan(12));
        journal.take(0, render, {0, 3, 4, 6}, std::span(a).subspan(12));
        journal.finish(1, json::object());
        journal.finish(0, json::object());
    }
    const Journal journal = Journal::open(folder(), identity);
    EXPECT_EQ(journal.read(0), pixels_of(0));
    EXPECT_EQ(journal.read(1), pixels_of(1));
}

TEST_F(JournalTest, ASectionUnderWayDoesNotCount) {
    {
        Journal journal = Journal::create(folder(), identity, plan);
        add(journal, 0);
        take_all(journal, 1);
    }
    EXPECT_THAT(ids(Journal::open(folder(), identity)), ElementsAre(0));
}

TEST_F(JournalTest, AFirstRowBeginsASectionAnew) {
    {
        Journal journal = Journal::create(folder(), identity, plan);
        const auto pixels = pixels_of(7);
        journal.take(0, render, {0, 0, 4, 5}, std::span(pixels).first(20));  // a lost attempt
        add(journal, 0);
    }
    const Journal journal = Journal::open(folder(), identity);
    EXPECT_THAT(ids(journal), ElementsAre(0));
    EXPECT_EQ(journal.read(0), pixels_of(0));
}

TEST_F(JournalTest, ALineThatWasCutOffDoesNotCountAndSpoilsNoOther) {
    leave_three();
    const fs::path lines = folder() / "sections.jsonl";
    const std::string whole = read(lines);
    for (const std::size_t cut : {2, 10, 30}) {
        SCOPED_TRACE(cut);
        write(lines, whole.substr(0, whole.size() - cut));
        Journal journal = Journal::open(folder(), identity);
        EXPECT_THAT(ids(journal), ElementsAre(0, 1));
        add(journal, 3);
        EXPECT_THAT(ids(journal), ElementsAre(0, 1, 3));
    }
    // Only the line's end is missing: all that it says is there.
    write(lines, whole.substr(0, whole.size() - 1));
    Journal journal = Journal::open(folder(), identity);
    add(journal, 3);
    EXPECT_THAT(ids(journal), ElementsAre(0, 1, 2, 3));
}

TEST_F(JournalTest, LinesThatAreNoEntriesDoNotCount) {
    leave_three();
    std::ofstream(folder() / "sections.jsonl", std::ios::app)
        << "[]\n7\n{}\n{\"section\": \"1\"}\n{\"section\": 2}\n"
        << "{\"section\": 2, \"sha1\": 5, \"about\": 1}\n";
    EXPECT_THAT(ids(Journal::open(folder(), identity)), ElementsAre(0, 1, 2));
}

TEST_F(JournalTest, DamagedPixelsDoNotCount) {
    leave_three();
    std::string pixels = read(folder() / "1.pixels");
    pixels[5] = static_cast<char>(pixels[5] ^ 1);
    write(folder() / "1.pixels", pixels);
    EXPECT_THAT(ids(Journal::open(folder(), identity)), ElementsAre(0, 2));
    fs::resize_file(folder() / "2.pixels", 23);
    EXPECT_THAT(ids(Journal::open(folder(), identity)), ElementsAre(0));
    fs::remove(folder() / "0.pixels");
    EXPECT_THAT(ids(Journal::open(folder(), identity)), IsEmpty());
}

TEST_F(JournalTest, PixelsOfAnotherSizeDoNotCountAndAreNotRead) {
    leave_three();
    fs::resize_file(folder() / "1.pixels", std::uintmax_t{1} << 40);  // takes no space
    EXPECT_THAT(ids(Journal::open(folder(), identity)), ElementsAre(0, 2));
}

TEST_F(JournalTest, SectionsThatThereAreNotDoNotCount) {
    leave_three();
    for (const char* number : {"7", "-1", "4294967297"}) {
        fs::copy_file(folder() / "1.pixels", folder() / (std::string(number) + ".pixels"));
        std::ofstream(folder() / "sections.jsonl", std::ios::app)
            << R"({"section":)" << number << R"(,"sha1":")" << sha1_of_file(folder() / "1.pixels")
            << R"(","about":{}})" << '\n';
    }
    EXPECT_THAT(ids(Journal::open(folder(), identity)), ElementsAre(0, 1, 2));
}

TEST_F(JournalTest, FinishingWithoutPixelsIsAFailure) {
    Journal journal = Journal::create(folder(), identity, plan);
    expect_failure(Exit::file, "5.pixels", [&] { journal.finish(5, json::object()); });
    EXPECT_THAT(ids(journal), IsEmpty());
    expect_failure(Exit::file, "cannot read", [&] { journal.read(5); });
}

TEST_F(JournalTest, AResumedRunCanBeResumedAgain) {
    leave_three();
    {
        Journal journal = Journal::open(folder(), identity);
        add(journal, 3);
    }
    EXPECT_THAT(ids(Journal::open(folder(), identity)), ElementsAre(0, 1, 2, 3));
}

TEST_F(JournalTest, WhatChangedIsNamed) {
    leave_three();
    for (const auto& [key, value] :
         {std::pair{"scene", json("ffff")}, std::pair{"arguments", json({"a.pov", "+W65"})}}) {
        json other = identity;
        other[key] = value;
        expect_failure(Exit::usage, key, [&] { Journal::open(folder(), other); });
    }
    json more = identity;
    more["image size"] = {64, 48};
    expect_failure(Exit::usage, "image size", [&] { Journal::open(folder(), more); });
}

TEST_F(JournalTest, NamesThatAreNoUtf8AreTheSameAgain) {
    const json odd{{"arguments", {"caf\xe9.pov"}}};
    Journal::create(folder(), odd, plan);
    EXPECT_NO_THROW(Journal::open(folder(), odd));
}

TEST_F(JournalTest, KeepsTheLastRadiosityCache) {
    {
        Journal journal = Journal::create(folder(), identity, plan);
        EXPECT_EQ(journal.cache().waves, 0);
        journal.keep_cache(1, "C1\n");
        journal.keep_cache(2, "C1\nC2\n");
        EXPECT_FALSE(fs::exists(folder() / "1.cache"));
    }
    Journal journal = Journal::open(folder(), identity);
    EXPECT_EQ(journal.cache().waves, 2);
    EXPECT_EQ(journal.cache().text, "C1\nC2\n");
    journal.remove();
    EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(JournalTest, ADamagedCacheDoesNotCount) {
    Journal journal = Journal::create(folder(), identity, plan);
    journal.keep_cache(1, "C1\nC2\n");
    std::string whole;
    {
        std::ifstream in(folder() / "1.cache");
        whole.assign(std::istreambuf_iterator<char>(in), {});
    }
    for (const std::string& damaged :
         {whole.substr(0, whole.size() - 1), whole.substr(0, 20), whole.substr(1), std::string()}) {
        std::ofstream(folder() / "1.cache") << damaged;
        EXPECT_EQ(journal.cache().waves, 0) << damaged;
        EXPECT_EQ(journal.cache().text, "");
    }
}

TEST_F(JournalTest, NothingToGoOnFrom) {
    expect_failure(Exit::usage, folder().string(), [&] { Journal::open(folder(), identity); });
    fs::create_directory(folder());
    expect_failure(Exit::usage, "--resume", [&] { Journal::open(folder(), identity); });
    Journal::create(folder(), identity, plan);
    EXPECT_THAT(ids(Journal::open(folder(), identity)), IsEmpty());
}

TEST_F(JournalTest, ADamagedJournalIsNamed) {
    leave_three();
    for (const char* text :
         {"", "{", "[]", "3", "{}", R"({"format": 5})",
          R"({"format": "mpipov-journal", "version": 2})",
          R"({"format": "mpipov-journal", "version": 2, "identity": {}, "plan": {}})",
          R"({"format": "mpipov-journal", "version": 1, "identity": {}, "plan": {},
              "folders made": 1})"}) {
        SCOPED_TRACE(text);
        write(folder() / "journal.json", text);
        expect_failure(Exit::file, "journal.json", [&] { Journal::open(folder(), identity); });
    }
}

TEST_F(JournalTest, ANewJournalTakesThePlaceOfAnOldOne) {
    leave_three();
    const Journal journal = Journal::create(folder(), identity, plan);
    EXPECT_THAT(ids(journal), IsEmpty());
    EXPECT_FALSE(fs::exists(folder() / "1.pixels"));
}

// --work-dir may name any folder: what is not a journal's must never be lost with it.
TEST_F(JournalTest, AFolderWithOtherFilesIsRefusedAndLeftAsItIs) {
    fs::create_directories(folder() / "photographs");
    write(folder() / "thesis.txt", "years");
    expect_failure(Exit::file, "--work-dir", [&] { Journal::create(folder(), identity, plan); });
    EXPECT_EQ(read(folder() / "thesis.txt"), "years");
    EXPECT_TRUE(fs::exists(folder() / "photographs"));
}

TEST_F(JournalTest, RemovingLeavesWhatIsNotAJournals) {
    leave_three();
    Journal journal = Journal::open(folder(), identity);
    take_all(journal, 3);
    write(folder() / "notes.pixels", "mine");
    journal.remove();
    EXPECT_EQ(read(folder() / "notes.pixels"), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder()), {}), 1);
}

TEST_F(JournalTest, RemovesItselfAsAWhole) {
    leave_three();
    Journal::open(folder(), identity).remove();
    EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(JournalTest, AFolderThatWasThereStays) {
    fs::create_directory(folder());
    leave_three();
    Journal::open(folder(), identity).remove();
    EXPECT_TRUE(fs::exists(folder()));
    EXPECT_TRUE(fs::is_empty(folder()));
}

TEST_F(JournalTest, AllFoldersThatItMadeGo) {
    fs::create_directory(folder());
    for (const char* deep : {"a/b/c", "a/b/c/"}) {
        const fs::path inner = folder() / deep;
        Journal::create(inner, identity, plan);
        Journal::create(inner, identity, plan);  // anew, in what an interrupted run left
        Journal::open(inner, identity).remove();
        EXPECT_TRUE(fs::exists(folder()));
        EXPECT_TRUE(fs::is_empty(folder())) << deep;
    }
    Journal journal = Journal::create(folder() / "a/b/c", identity, plan);
    write(folder() / "a/mine", "");
    journal.remove();
    EXPECT_TRUE(fs::exists(folder() / "a/mine"));
    EXPECT_FALSE(fs::exists(folder() / "a/b"));
}

TEST_F(JournalTest, AJournalThatCannotBeginLeavesNoFolder) {
    fs::create_directory(folder());
    const fs::path bad = folder() / "a" / std::string(300, 'n');
    expect_failure(Exit::file, "too long", [&] { Journal::create(bad, identity, plan); });
    EXPECT_TRUE(fs::is_empty(folder()));
}

TEST_F(JournalTest, AFolderThatCannotBeMadeIsNamed) {
    write(folder(), "a file");
    expect_failure(Exit::file, folder().string(),
                   [&] { Journal::create(folder(), identity, plan); });
    expect_failure(Exit::file, "/proc/none",
                   [&] { Journal::create("/proc/none", identity, plan); });
}

TEST_F(JournalTest, Sha1OfFiles) {
    const fs::path file = folder().parent_path() / "file";
    write(file, "abc");  // FIPS 180-4's own example
    EXPECT_EQ(sha1_of_file(file), "a9993e364706816aba3e25717850c26c9cd0d89d");
    EXPECT_EQ(sha1_of_file(folder() / "none"), "");
}

// None of it may end the program or take long: a disk that lost a block leaves such a journal.
TEST_F(JournalTest, ADamagedJournalIsNotBelieved) {
    const auto head = [](const std::string& folders, const std::string& with_plan) {
        return R"({"format": "mpipov-journal", "version": 2, "folders made": )" + folders +
               R"(, "identity": {}, "plan": )" + with_plan + "}";
    };
    const auto write = [&](const std::string& text) {
        fs::create_directories(folder());
        std::ofstream(folder() / "journal.json") << text;
    };
    write(head("0", std::string(1000000, '[') + std::string(1000000, ']')));
    EXPECT_THROW(Journal::open(folder(), json::object()), Failure);
    for (const char* folders : {"4294967297", "-1", "1.5", "true"}) {
        write(head(folders, "{}"));
        EXPECT_THROW(Journal::open(folder(), json::object()), Failure) << folders;
    }
    write(head("2147483647", "{}"));
    Journal journal = Journal::open(folder(), json::object());
    std::ofstream(folder() / "2147483647.cache") << "x";
    std::ofstream(folder() / "99999999999999.cache") << "x";
    EXPECT_EQ(journal.cache().waves, 0);
    std::ofstream(folder() / "sections.jsonl")
        << R"({"section": 4294967296, "sha1": "", "about": {}})" << '\n'
        << R"({"section": -1, "sha1": "", "about": {}})" << '\n';
    EXPECT_THAT(journal.finished(section_bytes), IsEmpty());
    journal.remove();
    EXPECT_FALSE(fs::exists(folder()));
}

}  // namespace
}  // namespace mpipov
