#include "child_process.h"

#include "scratch.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Optional;
using testing::StartsWith;

bool wait_until(const std::function<bool()>& done, double seconds = 10) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!done()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

// Gone, or dead and waiting for an init that may never reap it.
bool is_gone(int pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto name_end = text.rfind(')');
    return name_end == std::string::npos || text.substr(name_end, 3) == ") Z";
}

std::ptrdiff_t open_descriptors() {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
}

ChildRequest shell(const std::string& script) {
    ChildRequest request;
    request.argv = {"sh", "-c", script};
    return request;
}

// Every test must leave no child behind, dead or alive.
class ChildProcessTest : public testing::Test {
  protected:
    void TearDown() override {
        EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
        EXPECT_EQ(errno, ECHILD);
    }

    // The number that the child prints as the first line of its output.
    static int printed_pid(ChildProcess& child) {
        EXPECT_TRUE(wait_until([&] {
            child.poll();
            return child.output().find('\n') != std::string_view::npos;
        }));
        return std::atoi(std::string(child.output()).c_str());
    }
};

TEST_F(ChildProcessTest, MergesBothStreamsInOrder) {
    std::string output;
    const ChildResult result = run_to_end(shell("echo a; echo b >&2; echo c; cat"), &output);
    EXPECT_EQ(output, "a\nb\nc\n");  // and cat found nothing on stdin
    EXPECT_THAT(result.exit_code, Optional(0));
    EXPECT_FALSE(result.signal || result.timed_out || result.cancelled);
}

TEST_F(ChildProcessTest, ReportsExitCodeAndSignal) {
    const ChildResult code = run_to_end(shell("exit 3"));
    EXPECT_THAT(code.exit_code, Optional(3));
    EXPECT_FALSE(code.signal);
    const ChildResult signal = run_to_end(shell("kill -SEGV $$"));
    EXPECT_THAT(signal.signal, Optional(SIGSEGV));
    EXPECT_FALSE(signal.exit_code);
}

TEST_F(ChildProcessTest, MissingProgramIsExitCode127AndALineOfOutput) {
    ChildRequest request;
    request.argv = {"no-such-program-here"};
    std::string output;
    const ChildResult result = run_to_end(request, &output);
    EXPECT_THAT(result.exit_code, Optional(127));
    EXPECT_EQ(output, "mpipov: cannot start 'no-such-program-here': No such file or directory\n");
}

TEST_F(ChildProcessTest, RefusesRequestsThatCannotWork) {
    EXPECT_THROW(ChildProcess::start({}), std::invalid_argument);
    ChildRequest request = shell("true");
    request.environment = {{"A=B", "C"}};
    EXPECT_THROW(ChildProcess::start(request), std::invalid_argument);
    request = shell("true");
    request.working_directory = "/no/such/folder";
    EXPECT_THAT([&] { ChildProcess::start(request); },
                testing::ThrowsMessage<std::runtime_error>(
                    AllOf(HasSubstr("'sh'"), HasSubstr("/no/such/folder"))));
}

TEST_F(ChildProcessTest, TimeoutEndsAnObedientChildWithTerm) {
    ChildRequest request;
    request.argv = {"sleep", "60"};
    request.timeout_seconds = 0.2;
    const ChildResult result = run_to_end(request);
    EXPECT_THAT(result.signal, Optional(SIGTERM));
    EXPECT_TRUE(result.timed_out);
    EXPECT_FALSE(result.cancelled);
    EXPECT_GE(result.wall_seconds, 0.2);
    EXPECT_LT(result.wall_seconds, 0.2 + request.grace_seconds);
    EXPECT_LT(result.cpu_seconds, 0.1);
}

TEST_F(ChildProcessTest, TimeoutKillsAChildThatIgnoresTerm) {
    ChildRequest request = shell("trap '' TERM; echo ready; while :; do sleep 0.05; done");
    request.timeout_seconds = 0.8;
    request.grace_seconds = 0.3;
    std::string output;
    const ChildResult result = run_to_end(request, &output);
    EXPECT_EQ(output.substr(0, 6), "ready\n");
    EXPECT_THAT(result.signal, Optional(SIGKILL));
    EXPECT_TRUE(result.timed_out);
    EXPECT_GE(result.wall_seconds, 1.1);
    EXPECT_LT(result.wall_seconds, 10);
}

TEST_F(ChildProcessTest, TerminateLetsTheChildChooseItsExitCode) {
    ChildProcess child =
        ChildProcess::start(shell("trap 'exit 7' TERM; echo ready; while :; do sleep 0.05; done"));
    ASSERT_TRUE(wait_until([&] { return child.poll() || !child.output().empty(); }));
    EXPECT_THROW(child.result(), std::logic_error);
    child.terminate();
    ASSERT_TRUE(wait_until([&] { return child.poll(); }));
    EXPECT_THAT(child.result().exit_code, Optional(7));
    EXPECT_TRUE(child.result().cancelled);
    EXPECT_FALSE(child.result().timed_out);
}

TEST_F(ChildProcessTest, TerminateTurnsIntoKillAfterTheGraceTime) {
    ChildRequest request = shell("trap '' TERM; echo ready; while :; do sleep 0.05; done");
    request.grace_seconds = 0.2;
    ChildProcess child = ChildProcess::start(request);
    ASSERT_TRUE(wait_until([&] { return child.poll() || !child.output().empty(); }));
    child.terminate();
    EXPECT_FALSE(child.poll());
    EXPECT_LE(child.wait_milliseconds(), 200);
    ASSERT_TRUE(wait_until([&] { return child.poll(); }));
    EXPECT_THAT(child.result().signal, Optional(SIGKILL));
    EXPECT_TRUE(child.result().cancelled);
}

TEST_F(ChildProcessTest, KillNowReachesTheWholeGroup) {
    ChildProcess child = ChildProcess::start(shell("sleep 60 & echo $!; wait"));
    const int grandchild = printed_pid(child);
    ASSERT_GT(grandchild, 0);
    EXPECT_FALSE(is_gone(grandchild));
    child.kill_now();
    ASSERT_TRUE(wait_until([&] { return child.poll(); }));
    EXPECT_THAT(child.result().signal, Optional(SIGKILL));
    EXPECT_TRUE(wait_until([&] { return is_gone(grandchild); }));
}

TEST_F(ChildProcessTest, WhatOutlivesTheProgramIsKilledAndHoldsNothingUp) {
    ChildProcess child = ChildProcess::start(shell("sleep 60 & echo $!"));
    ASSERT_TRUE(wait_until([&] { return child.poll(); }, 5));
    const int grandchild = printed_pid(child);
    ASSERT_GT(grandchild, 0);
    EXPECT_THAT(child.result().exit_code, Optional(0));
    EXPECT_TRUE(wait_until([&] { return is_gone(grandchild); }));
}

TEST_F(ChildProcessTest, DestructorKillsTheGroupAndReaps) {
    int pid = 0;
    int grandchild = 0;
    {
        ChildProcess child =
            ChildProcess::start(shell("trap '' TERM; sleep 60 & echo $!; wait; wait"));
        pid = child.pid();
        grandchild = printed_pid(child);
    }
    ASSERT_GT(grandchild, 0);
    EXPECT_FALSE(fs::exists("/proc/" + std::to_string(pid)));  // not even a zombie
    EXPECT_TRUE(wait_until([&] { return is_gone(grandchild); }));
}

TEST_F(ChildProcessTest, MovesLikeAValue) {
    std::vector<ChildProcess> children;
    children.reserve(5);
    for (int i = 0; i < 5; ++i) {
        children.push_back(ChildProcess::start(shell("echo " + std::to_string(i))));
    }
    children.erase(children.begin());
    for (int i = 1; i < 5; ++i) {
        ChildProcess& child = children.at(static_cast<std::size_t>(i) - 1);
        ASSERT_TRUE(wait_until([&] { return child.poll(); }));
        EXPECT_EQ(child.output(), std::to_string(i) + "\n");
    }
}

TEST_F(ChildProcessTest, EnvironmentIsAddedAndReplaced) {
    ::setenv("MPIPOV_TEST_KEPT", "kept", 1);
    ::setenv("MPIPOV_TEST_OLD", "old", 1);
    ChildRequest request = shell("env | grep MPIPOV_TEST | sort");
    request.environment = {{"MPIPOV_TEST_OLD", "new"}, {"MPIPOV_TEST_ADDED", "a=b"}};
    std::string output;
    run_to_end(request, &output);
    EXPECT_EQ(output, "MPIPOV_TEST_ADDED=a=b\nMPIPOV_TEST_KEPT=kept\nMPIPOV_TEST_OLD=new\n");
    EXPECT_STREQ(std::getenv("MPIPOV_TEST_OLD"), "old");
    ::unsetenv("MPIPOV_TEST_KEPT");
    ::unsetenv("MPIPOV_TEST_OLD");
}

TEST_F(ChildProcessTest, RunsInItsWorkingDirectory) {
    const ScratchFolder folder("child-test");
    ChildRequest request = shell("pwd -P");
    request.working_directory = folder.path();
    std::string output;
    run_to_end(request, &output);
    EXPECT_EQ(output, folder.path().string() + "\n");
}

TEST_F(ChildProcessTest, AProgramGivenAsAFileIsSeenFromOurFolder) {
    const ScratchFolder folder("child-test");
    ChildRequest request;
    request.argv = {fs::relative("/bin/sh").string(), "-c", "echo here"};
    ASSERT_THAT(request.argv[0], HasSubstr("/"));
    ASSERT_FALSE(fs::path(request.argv[0]).is_absolute());
    fs::create_directories(folder.path() / "a/b/c/d/e/f/g/h/i/j/k/l/m/n/o/p");
    request.working_directory = folder.path() / "a/b/c/d/e/f/g/h/i/j/k/l/m/n/o/p";
    std::string output;
    run_to_end(request, &output);
    EXPECT_EQ(output, "here\n");
}

TEST_F(ChildProcessTest, KeepsTheFirstAndTheLastHalfOfMuchOutput) {
    ChildRequest request = shell("seq 1 300000");  // about 2 MB
    request.capture_limit = 1000;
    std::string output;
    EXPECT_THAT(run_to_end(request, &output).exit_code, Optional(0));
    EXPECT_THAT(output, StartsWith("1\n2\n3\n"));
    EXPECT_THAT(output, EndsWith("299999\n300000\n"));
    const std::size_t marker = output.find("\n[mpipov: ");
    ASSERT_EQ(marker, 500U);
    const std::size_t marker_end = output.find("]\n", marker) + 2;
    EXPECT_EQ(output.size() - marker_end, 500U);
}

TEST_F(ChildProcessTest, OutputOfExactlyTheLimitIsWhole) {
    ChildRequest request = shell("printf 0123456789");
    request.capture_limit = 10;
    std::string output;
    run_to_end(request, &output);
    EXPECT_EQ(output, "0123456789");
    request.capture_limit = 9;
    run_to_end(request, &output);
    EXPECT_THAT(output, AllOf(StartsWith("0123\n[mpipov: "), EndsWith("]\n56789")));
}

TEST_F(ChildProcessTest, AChatterboxDoesNotHoldUpTheTimeout) {
    ChildRequest request;
    request.argv = {"yes"};
    request.timeout_seconds = 0.3;
    request.capture_limit = 4096;
    const ChildResult result = run_to_end(request);
    EXPECT_TRUE(result.timed_out);
    EXPECT_LT(result.wall_seconds, 5);
}

TEST_F(ChildProcessTest, ExitDescriptorTellsTheEndOfAChildWithoutStreams) {
    ChildProcess child = ChildProcess::start(shell("exec >&- 2>&-; sleep 0.3; exit 5"));
    ASSERT_TRUE(wait_until([&] { return child.poll() || child.output_fd() < 0; }));
    ASSERT_FALSE(child.ended());
    ASSERT_GE(child.exit_fd(), 0);
    pollfd end{child.exit_fd(), POLLIN, 0};
    ASSERT_EQ(::poll(&end, 1, 10000), 1);
    ASSERT_TRUE(child.poll());
    EXPECT_THAT(child.result().exit_code, Optional(5));
    EXPECT_EQ(child.exit_fd(), -1);
}

TEST_F(ChildProcessTest, LeaksNoDescriptorOverManyStarts) {
    const auto before = open_descriptors();
    for (int i = 0; i < 200; ++i) {
        ChildProcess child = ChildProcess::start(shell(""));
        if (i % 2 == 0) {
            ASSERT_TRUE(wait_until([&] { return child.poll(); }));
        }
    }
    EXPECT_EQ(open_descriptors(), before);
}

TEST_F(ChildProcessTest, ChildInheritsNoDescriptor) {
    const int leaky = ::open("/dev/null", O_RDONLY);  // NOLINT: without O_CLOEXEC on purpose
    ASSERT_GT(leaky, 2);
    std::string output;
    run_to_end(shell("ls /proc/$$/fd; true"), &output);
    ::close(leaky);
    EXPECT_EQ(output, "0\n1\n2\n");
}

TEST_F(ChildProcessTest, SignalsAreDefaultAndUnblockedInTheChild) {
    sigset_t term{};
    sigset_t old{};
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    ASSERT_EQ(::sigprocmask(SIG_BLOCK, &term, &old), 0);
    auto* const handler = std::signal(SIGPIPE, SIG_IGN);
    std::string output;
    ChildRequest request;  // not through a shell, which clears its mask itself
    request.argv = {"sed", "-n", "s/^SigBlk:.//p; s/^SigIgn:.//p", "/proc/self/status"};
    run_to_end(request, &output);
    std::signal(SIGPIPE, handler);
    ::sigprocmask(SIG_SETMASK, &old, nullptr);
    const std::size_t line_end = output.find('\n');
    ASSERT_NE(line_end, std::string::npos);
    EXPECT_EQ(output.substr(0, line_end), "0000000000000000");
    // Bits 31 and 32 are glibc's own two signals, which posix_spawn leaves ignored.
    const std::uint64_t ignored = std::stoull(output.substr(line_end + 1), nullptr, 16);
    EXPECT_EQ(ignored & ~std::uint64_t{0x180000000}, 0U) << output;
}

TEST_F(ChildProcessTest, ChildDiesWithAParentThatIsKilled) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    const pid_t parent = ::fork();
    ASSERT_GE(parent, 0);
    if (parent == 0) {
        ChildRequest request;
        request.argv = {"sleep", "60"};
        const ChildProcess child = ChildProcess::start(request);
        const int pid = child.pid();
        if (::write(ends[1], &pid, sizeof pid) != sizeof pid) ::_exit(1);
        for (;;) ::pause();
    }
    int pid = 0;
    ::close(ends[1]);
    ASSERT_EQ(::read(ends[0], &pid, sizeof pid), static_cast<ssize_t>(sizeof pid));
    ::close(ends[0]);
    // Only once it is sleep, the guard has done its part.
    ASSERT_TRUE(wait_until([&] {
        std::string name;
        return std::getline(std::ifstream("/proc/" + std::to_string(pid) + "/comm"), name) &&
               name == "sleep";
    }));
    ASSERT_EQ(::kill(parent, SIGKILL), 0);
    ASSERT_EQ(::waitpid(parent, nullptr, 0), parent);
    EXPECT_TRUE(wait_until([&] { return is_gone(pid); }));
}

// --povray may name a script that starts POV-Ray as a child of its own.
TEST_F(ChildProcessTest, WhatAScriptStartedDiesWithAParentThatIsKilled) {
    // Without the first line the shell runs it all the same.
    for (const char* first_line : {"#!/bin/sh\n", ""}) {
        SCOPED_TRACE(first_line);
        const ScratchFolder folder("script-test");
        const std::string script = folder.path() / "script", number = folder.path() / "number";
        std::ofstream(script) << first_line << "sleep 60 &\necho $! > '" << number << "'\nwait\n";
        std::filesystem::permissions(script, std::filesystem::perms::owner_all);
        const pid_t parent = ::fork();
        ASSERT_GE(parent, 0);
        if (parent == 0) {
            ChildRequest request;
            request.argv = {script};
            const ChildProcess child = ChildProcess::start(request);
            for (;;) ::pause();
        }
        int pid = 0;
        EXPECT_TRUE(wait_until([&] { return bool(std::ifstream(number) >> pid) && pid > 0; }));
        ASSERT_EQ(::kill(parent, SIGKILL), 0);
        ASSERT_EQ(::waitpid(parent, nullptr, 0), parent);
        EXPECT_TRUE(wait_until([&] { return is_gone(pid); }));
    }
}

TEST_F(ChildProcessTest, GuardStartsNothingForAParentThatIsGone) {
    ChildRequest request;
    request.argv = {find_guard().string(), "1", "0", "0", "free", "--", "echo", "started"};
    std::string output;
    EXPECT_THAT(run_to_end(request, &output).exit_code, Optional(127));
    EXPECT_THAT(output, HasSubstr("parent is gone, not starting 'echo'"));
    request.argv[1] = std::to_string(::getpid());  // the outer guard has become the inner one
    EXPECT_THAT(run_to_end(request, &output).exit_code, Optional(0));
    EXPECT_EQ(output, "started\n");
    request.argv[2] = "much";
    EXPECT_THAT(run_to_end(request, &output).exit_code, Optional(127));
    EXPECT_THAT(output, HasSubstr("'much'"));
}

TEST_F(ChildProcessTest, MissingGuardIsAClearError) {
    ::setenv("MPIPOV_GUARD", "/no/such/guard", 1);
    EXPECT_THAT([] { run_to_end(shell("true")); },
                testing::ThrowsMessage<std::runtime_error>(
                    AllOf(HasSubstr("MPIPOV_GUARD"), HasSubstr("/no/such/guard"))));
    ::unsetenv("MPIPOV_GUARD");
    EXPECT_EQ(find_guard().filename(), "mpipov-guard");
}

TEST_F(ChildProcessTest, MemoryLimitHolds) {
    ChildRequest request;
    request.argv = {"dd", "if=/dev/zero", "of=/dev/null", "bs=128M", "count=1"};
    EXPECT_THAT(run_to_end(request).exit_code, Optional(0));
    request.memory_limit_bytes = std::uint64_t{64} << 20;
    std::string output;
    EXPECT_THAT(run_to_end(request, &output).exit_code, Optional(1));
    EXPECT_THAT(output, HasSubstr("memory"));
}

TEST_F(ChildProcessTest, FileSizeLimitHolds) {
    const ScratchFolder folder("child-test");
    ChildRequest request;
    request.argv = {"dd", "if=/dev/zero", "of=big", "bs=4096", "count=10"};
    request.working_directory = folder.path();
    EXPECT_THAT(run_to_end(request).exit_code, Optional(0));
    EXPECT_EQ(fs::file_size(folder.path() / "big"), 40960U);
    request.file_size_limit_bytes = 10000;
    EXPECT_THAT(run_to_end(request).signal, Optional(SIGXFSZ));
    EXPECT_LE(fs::file_size(folder.path() / "big"), 10000U);
}

TEST_F(ChildProcessTest, FolderLimitHolds) {
    for (const char* script : {"dd if=/dev/zero of=big bs=4096 count=100 2>/dev/null; sleep 60",
                               "for i in $(seq 100); do : > f$i; done; sleep 60"}) {
        const ScratchFolder folder("child-test");
        ChildRequest request = shell(script);
        request.working_directory = folder.path();
        request.folder_limit = {folder.path(), 100000};
        const ChildResult result = run_to_end(request);
        EXPECT_TRUE(result.filled_folder) << script;
        EXPECT_THAT(result.signal, Optional(SIGTERM)) << script;
        EXPECT_LT(result.wall_seconds, 30) << script;
    }
    const ScratchFolder folder("child-test");
    ChildRequest request = shell("truncate -s 1G holes; sleep 0.5");
    request.working_directory = folder.path();
    request.folder_limit = {folder.path(), 1000000};
    EXPECT_FALSE(run_to_end(request).filled_folder);
    // The folder in which a scene that writes runs is made of links, which POV-Ray cannot make.
    for (int i = 0; i < 300; ++i)
        fs::create_symlink("/", folder.path() / ("link" + std::to_string(i)));
    EXPECT_FALSE(run_to_end(request).filled_folder);
}

TEST_F(ChildProcessTest, CpuSecondsCountTheChildAndWhatItWaitedFor) {
    const std::string busy = "i=0; while [ $i -lt 300000 ]; do i=$((i+1)); done";
    for (const std::string& script : {busy, "(" + busy + "); true"}) {
        const ChildResult result = run_to_end(shell(script));
        EXPECT_GT(result.cpu_seconds, 0.05) << script;
        EXPECT_LE(result.cpu_seconds, result.wall_seconds * 1.1 + 0.05) << script;
    }
}

TEST_F(ChildProcessTest, TellsOfARunningChildWhatItSpentAndWhetherAFileIsOpen) {
    const ScratchFolder folder("child-test");
    const std::string file = (folder.path() / "file").string();
    const std::string spin = "i=0; while [ $i -lt 20000 ]; do i=$((i+1)); done; ";
    for (const bool open : {true, false}) {
        ChildProcess child = ChildProcess::start(
            shell(spin + (open ? "exec 3>'" + file + "'; " : "") + "echo ready; exec sleep 1000"));
        ASSERT_TRUE(wait_until([&] { return child.poll() || child.output() == "ready\n"; }));
        EXPECT_FALSE(child.ended());
        EXPECT_EQ(child.has_file_open(), open);
        EXPECT_GT(child.cpu_seconds(), 0.001);
        EXPECT_GE(child.wall_seconds(), child.cpu_seconds());
        child.kill_now();
        ASSERT_TRUE(wait_until([&] { return child.poll(); }));
        EXPECT_FALSE(child.has_file_open());
        EXPECT_EQ(child.cpu_seconds(), child.result().cpu_seconds);
        EXPECT_EQ(child.wall_seconds(), child.result().wall_seconds);
    }
}

// What a wrapper around a program has open cannot be told: it could be anything.
TEST_F(ChildProcessTest, AChildWithChildrenMayHaveAFileOpen) {
    ChildProcess child = ChildProcess::start(shell("sleep 1000 & echo ready; wait"));
    ASSERT_TRUE(wait_until([&] { return child.poll() || child.output() == "ready\n"; }));
    EXPECT_TRUE(child.has_file_open());
}

TEST_F(ChildProcessTest, ATimeoutCanBeginLater) {
    ChildRequest request = shell("exec sleep 1000");
    ChildProcess child = ChildProcess::start(request);
    EXPECT_FALSE(child.poll());
    child.set_timeout(0.05);
    ASSERT_TRUE(wait_until([&] { return child.poll(); }));
    EXPECT_TRUE(child.result().timed_out);
}

TEST_F(ChildProcessTest, PeakMemoryIsTheChildsNotOurs) {
    constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;
    const std::vector<char> ours(100 * mebibyte, 1);
    ASSERT_EQ(ours.back(), 1);
    EXPECT_LT(run_to_end(shell("sleep 0.3")).max_rss_bytes, 50 * mebibyte);
    ChildRequest request;
    // It has them until its input ends, long enough to be seen: what the kernel says at the end is
    // not believed where we have more ourselves, as with sanitizers.
    request.argv = {"bash", "-c",
                    "exec dd of=/dev/null bs=301M count=1 iflag=fullblock"
                    " < <(head -c 300M /dev/zero; exec sleep 0.3)"};
    EXPECT_GT(run_to_end(request).max_rss_bytes, 280 * mebibyte);
}

}  // namespace
}  // namespace mpipov
