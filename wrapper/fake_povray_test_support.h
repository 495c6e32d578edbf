// For tests that launch the stand-in for POV-Ray (fake_povray_main.cpp).
#pragma once

#include "coordinator.h"
#include "povray_command.h"
#include "scratch.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>

namespace mpipov {

// An environment variable for the life of this.
class Environment {
  public:
    Environment(std::string name, const std::string& value) : name_(std::move(name)) {
        ::setenv(name_.c_str(), value.c_str(), 1);
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;
    ~Environment() { ::unsetenv(name_.c_str()); }

  private:
    std::string name_;
};

inline Environment faults(const std::string& what) {
    return {"FAKE_POVRAY", what};
}

inline JobCommand fake_job(const ImageSize& image) {
    JobCommand job;
    job.povray = MPIPOV_FAKE_POVRAY;
    job.user_arguments = {"+Iscene.pov", "+W" + std::to_string(image.width),
                          "+H" + std::to_string(image.height)};
    return job;
}

inline double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// Ranks that launch the stand-in for sections of `frame`, one at a time.
inline CoordinatorSetup launching_setup(const Rect& frame, int ranks, int sections) {
    CoordinatorSetup c;
    c.partition = make_partition({frame, Shape::columns, Seams::halo, sections, 2, 32});
    c.image = {frame.width(), frame.height()};
    c.job = fake_job(c.image);
    for (int rank = 0; rank < ranks; ++rank) c.ranks.push_back({rank, "host", 1, 0, 0});
    c.in_flight.assign(c.ranks.size(), 1);
    return c;
}

// A scratch folder for a worker's section files; at the end of a test nothing is left in it, and no
// child process.
class FakePovrayTest : public testing::Test {
  protected:
    void TearDown() override {
        EXPECT_EQ(files_left(), 0);
        EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
        EXPECT_EQ(errno, ECHILD);
    }

    std::ptrdiff_t files_left() const {
        return std::distance(std::filesystem::directory_iterator(scratch_.path()),
                             std::filesystem::directory_iterator());
    }

    const ScratchFolder scratch_{"protocol-test"};
    const ScratchFolder elsewhere_{"protocol-test"};
};

}  // namespace mpipov
