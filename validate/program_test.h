// For tests that run mpipov-validate as a whole: in a folder of their own.
#pragma once

#include "child_process.h"
#include "scratch.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mpipov {

class ProgramTest : public testing::Test {
  protected:
    // `subcommand` comes before the arguments of every run(); may be empty.
    explicit ProgramTest(std::vector<std::string> subcommand)
        : subcommand_(std::move(subcommand)) {}

    // The exit code; -1 where a signal ended it.
    int run(const std::vector<std::string>& arguments) {
        ChildRequest request;
        request.argv = {MPIPOV_VALIDATE_PROGRAM};
        request.argv.insert(request.argv.end(), subcommand_.begin(), subcommand_.end());
        request.argv.insert(request.argv.end(), arguments.begin(), arguments.end());
        request.working_directory = folder_.path();
        output_.clear();
        return run_to_end(request, &output_).exit_code.value_or(-1);
    }

    // The same with standard output on a full disk; output_ is standard error.
    int run_on_full_disk(const std::vector<std::string>& arguments) {
        std::vector<std::string> words{"-c", "exec \"$0\" \"$@\" >/dev/full",
                                       MPIPOV_VALIDATE_PROGRAM};
        words.insert(words.end(), subcommand_.begin(), subcommand_.end());
        words.insert(words.end(), arguments.begin(), arguments.end());
        ChildRequest request;
        request.argv = {"sh"};
        request.argv.insert(request.argv.end(), words.begin(), words.end());
        request.working_directory = folder_.path();
        output_.clear();
        return run_to_end(request, &output_).exit_code.value_or(-1);
    }

    std::filesystem::path path(const std::filesystem::path& name) const {
        return folder_.path() / name;
    }

    ScratchFolder folder_{"test"};
    std::string output_;  // both streams of the last run

  private:
    std::vector<std::string> subcommand_;
};

}  // namespace mpipov
