#include "hydra.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>

namespace mpipov {
namespace {

class HydraTest : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()), 0);
        ::fcntl(ends_[0], F_SETFL, O_NONBLOCK);
        ::setenv("PMI_FD", std::to_string(ends_[1]).c_str(), 1);
        ::setenv("MPI_LOCALNRANKS", "1", 1);
    }
    void TearDown() override {
        ::unsetenv("PMI_FD");
        ::unsetenv("MPI_LOCALNRANKS");
        for (const int end : ends_) ::close(end);
    }
    std::string heard() const {
        std::array<char, 100> text{};
        const ssize_t count = ::read(ends_[0], text.data(), text.size());
        return {text.data(), static_cast<std::size_t>(count < 0 ? 0 : count)};
    }

    std::array<int, 2> ends_{};
};

TEST_F(HydraTest, IsToldAndHeardOut) {
    const std::string answer = "cmd=finalize_ack\n";
    ASSERT_EQ(::write(ends_[0], answer.data(), answer.size()), static_cast<ssize_t>(answer.size()));
    take_leave_of_hydra();
    EXPECT_EQ(heard(), "cmd=finalize\n");
    ::fcntl(ends_[1], F_SETFL, O_NONBLOCK);
    char left = 0;
    EXPECT_EQ(::read(ends_[1], &left, 1), -1) << "the answer was taken";
}

TEST_F(HydraTest, OthersAreToldNothing) {
    ::unsetenv("MPI_LOCALNRANKS");
    take_leave_of_hydra();
    EXPECT_EQ(heard(), "");
    ::setenv("MPI_LOCALNRANKS", "1", 1);
    ::unsetenv("PMI_FD");
    take_leave_of_hydra();
    EXPECT_EQ(heard(), "");
}

TEST_F(HydraTest, WhereHydraIsGoneItIsNoMatter) {
    ::signal(SIGPIPE, SIG_IGN);
    ::shutdown(ends_[0], SHUT_RDWR);
    take_leave_of_hydra();
    ::signal(SIGPIPE, SIG_DFL);
}

TEST(WaitUntilRead, WaitsForTheReaderOfAPipe) {
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    EXPECT_TRUE(wait_until_read(pipe[1], 0)) << "there is nothing to read";
    ASSERT_EQ(::write(pipe[1], "last words", 10), 10);
    EXPECT_FALSE(wait_until_read(pipe[1], 0.01)) << "nobody reads it";
    std::jthread reader([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        std::array<char, 10> text{};
        EXPECT_EQ(::read(pipe[0], text.data(), text.size()), 10);
    });
    EXPECT_TRUE(wait_until_read(pipe[1], 60));
    reader.join();
    for (const int end : pipe) ::close(end);
}

TEST(WaitUntilRead, IsForPipesAlone) {
    const int file = ::open("/proc/self/exe", O_RDONLY | O_CLOEXEC);
    EXPECT_TRUE(wait_until_read(file, 60));
    ::close(file);
    EXPECT_TRUE(wait_until_read(-1, 60));
}

}  // namespace
}  // namespace mpipov
