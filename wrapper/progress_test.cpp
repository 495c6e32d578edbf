#include "progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <system_error>

namespace mpipov {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// What is printed to standard error meanwhile, which is no terminal then.
template <typename Action>
std::string printed(Action action) {
    testing::internal::CaptureStderr();
    action();
    return testing::internal::GetCapturedStderr();
}

std::ptrdiff_t lines(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

TEST(Progress, LineSaysHowFarAndHowLong) {
    EXPECT_EQ(progress_line(0.43, 7, 16, 9), "43 %, 7 of 16 sections, 12 s left");
    EXPECT_EQ(progress_line(0.5, 1, 2, 90), "50 %, 1 of 2 sections, 1 min 30 s left");
    EXPECT_EQ(progress_line(0.5, 1, 2, 7500), "50 %, 1 of 2 sections, 2 h 05 min left");
}

TEST(Progress, LineGuessesNothingAtTheEnds) {
    EXPECT_EQ(progress_line(0, 0, 4, 100), "0 %, 0 of 4 sections");
    EXPECT_EQ(progress_line(1, 4, 4, 100), "100 %, 4 of 4 sections");
    EXPECT_THAT(progress_line(0.9999999, 3, 4, 0), testing::StartsWith("99 %"));
    EXPECT_EQ(progress_line(1, 3, 4, 100), "99 %, 3 of 4 sections");
    EXPECT_EQ(progress_line(0.5, 2, 4, 0.5), "50 %, 2 of 4 sections");
}

TEST(Progress, LineGuessesNothingThatNobodyKnows) {
    EXPECT_EQ(progress_line(1e-300, 0, 4, 100), "0 %, 0 of 4 sections");
    EXPECT_EQ(progress_line(5e-324, 0, 4, 1e300), "0 %, 0 of 4 sections");
    EXPECT_EQ(progress_line(0.5, 0, 4, -100), "50 %, 0 of 4 sections");
}

TEST(Progress, AClockThatGoesBackSilencesNothing) {
    const std::string text = printed([] {
        ProgressView view(ProgressStyle::plain);
        view.update(0.01, 0, 1, 1e6);
        for (int i = 0; i <= 60; ++i) view.update(0.01 + i * 0.001, 0, 1, i);
    });
    EXPECT_GE(lines(text), 6);
    EXPECT_LE(lines(text), 8);
}

TEST(Progress, NotFinishedIsNeverAHundred) {
    EXPECT_THAT(progress_line(0.9999, 15, 16, 0), testing::StartsWith("99 %"));
}

TEST(Progress, PlainLinesComeEveryTenthOrTenSeconds) {
    const std::string text = printed([] {
        ProgressView view(ProgressStyle::plain);
        for (int i = 0; i <= 1000; ++i) view.update(i / 1000.0, 0, 1, i * 0.001);
    });
    EXPECT_GE(lines(text), 10);
    EXPECT_LE(lines(text), 12);
    const std::string slow = printed([] {
        ProgressView view(ProgressStyle::plain);
        for (int i = 0; i <= 100; ++i) view.update(i / 10000.0, 0, 1, i);
    });
    EXPECT_GE(lines(slow), 10);
    EXPECT_LE(lines(slow), 11);
}

TEST(Progress, PlainSaysNothingTwice) {
    const std::string text = printed([] {
        ProgressView view(ProgressStyle::plain);
        for (int i = 0; i < 100; ++i) view.update(0.25, 1, 4, i * 20.0);
    });
    EXPECT_EQ(lines(text), 1) << text;
}

TEST(Progress, AutomaticIsPlainWhereThereIsNoTerminal) {
    const std::string text = printed([] {
        ProgressView view(ProgressStyle::automatic);
        view.update(0.5, 1, 2, 0);
        view.say("a warning");
    });
    EXPECT_EQ(text, "mpipov: 50 %, 1 of 2 sections\na warning\n");
    EXPECT_THAT(text, AllOf(Not(HasSubstr("\r")), Not(HasSubstr("\x1b"))));
}

// Standard error is a terminal for as long as this lives.
class Terminal {
  public:
    Terminal() : stderr_(::dup(STDERR_FILENO)) {
        int inner = -1;
        if (::openpty(&outer_, &inner, nullptr, nullptr, nullptr) != 0)
            throw std::system_error(errno, std::generic_category(), "openpty");
        ::dup2(inner, STDERR_FILENO);
        ::close(inner);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;
    ~Terminal() {
        leave();
        ::close(outer_);
    }
    // All that was shown, and the end of it.
    std::string leave() {
        std::string shown;
        if (stderr_ < 0) return shown;
        ::dup2(stderr_, STDERR_FILENO);
        ::close(stderr_);
        stderr_ = -1;
        std::array<char, 4096> text{};
        for (ssize_t size = 0; (size = ::read(outer_, text.data(), text.size())) > 0;)
            shown.append(text.data(), static_cast<std::size_t>(size));
        return shown;
    }

  private:
    int stderr_, outer_ = -1;
};

TEST(Progress, OnATerminalOneLineIsWrittenOverAndOver) {
    std::string text;
    {
        Terminal terminal;
        ProgressView view(ProgressStyle::automatic);
        for (int i = 0; i <= 10; ++i) view.update(i / 20.0, i, 20, i * 0.05);
        view.say("a warning");
        text = terminal.leave();
    }
    EXPECT_THAT(text, HasSubstr("\r0 %, 0 of 20 sections\x1b[K\r20 %, 4 of 20 sections\x1b[K\r"));
    EXPECT_THAT(text, testing::EndsWith("\r\x1b[Ka warning\r\n")) << "above the live line";
    EXPECT_EQ(lines(text), 1);
}

TEST(Progress, NoneIsSilent) {
    EXPECT_EQ(printed([] {
                  ProgressView view(ProgressStyle::none);
                  view.update(0.5, 1, 2, 100);
                  view.inform("resumed");
              }),
              "");
    EXPECT_EQ(printed([] { ProgressView(ProgressStyle::none).say("a warning"); }), "a warning\n")
        << "that is no progress";
}

}  // namespace
}  // namespace mpipov
