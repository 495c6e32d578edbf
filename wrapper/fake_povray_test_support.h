// For tests that launch the stand-in for POV-Ray (fake_povray_main.cpp).
#pragma once

#include "povray_command.h"
#include "scratch.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
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
