// One running program (POV-Ray), for a single-threaded event loop over ::poll().
//
// The program starts through mpipov-guard (guard_main.cpp) in a process group of its own, with
// stdin from /dev/null, stdout and stderr merged into one pipe, no other inherited descriptor, and
// default signal dispositions and mask. TERM and KILL go to the whole group; whatever of the group
// outlives the program itself is killed with it.
//
// The program is killed when we die, even by SIGKILL. Linux ties that (PR_SET_PDEATHSIG) to the
// *thread* that called start(): call it from a thread that outlives the child, or the child dies
// with the thread. What the program itself starts is not covered: only the program is.
//
// SIGCHLD must not be ignored, and nobody else may reap our children; otherwise results have
// neither exit code nor signal.
#pragma once

#include "landlock.h"

#include <poll.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mpipov {

// A folder that the program may fill so far; then it gets TERM. Looked at a few times a second.
struct FolderLimit {
    std::filesystem::path folder;
    std::uint64_t bytes = 0;
};

struct ChildRequest {
    // argv[0] is looked up on the child's PATH; with a '/' it is a file, seen from our own folder.
    std::vector<std::string> argv;
    std::vector<std::pair<std::string, std::string>> environment;  // added to ours, or replacing
    std::filesystem::path working_directory;                       // empty: ours
    std::optional<double> timeout_seconds;                         // from start() to TERM
    double grace_seconds = 2.0;                                    // from TERM to KILL
    std::size_t capture_limit = std::size_t{4} << 20;  // bytes of output to keep, see output()
    std::optional<std::uint64_t> memory_limit_bytes;   // of what it can write to, RLIMIT_DATA
    std::optional<std::uint64_t> file_size_limit_bytes;
    std::optional<FolderLimit> folder_limit;
    std::optional<FileAccess> files;  // nothing else of the file system; not given: all of it
};

struct ChildResult {
    std::optional<int> exit_code;  // 127: the program could not be started, see the output
    std::optional<int> signal;     // that ended it
    bool timed_out = false;        // it got TERM because its time was up
    double timeout_seconds = 0;    // that time, where it was
    bool filled_folder = false;    // it got TERM because of its folder_limit
    bool cancelled = false;        // terminate() or kill_now() was called
    double wall_seconds = 0;       // from start() until poll() saw the end
    double cpu_seconds = 0;        // user + system, of the child and of what it waited for
    // Peak resident set. Exact where it is clearly above our own peak at start(); else the largest
    // sample taken by poll(), a lower bound (0: none), because Linux counts our own pages to a
    // child until it calls exec.
    std::uint64_t max_rss_bytes = 0;
};

class ChildProcess {
  public:
    // Throws std::invalid_argument (empty argv, bad environment name), std::runtime_error (no
    // guard, no such working directory) or std::system_error, each naming the program. That the
    // program itself cannot be executed is no exception but exit code 127 and a line of output.
    static ChildProcess start(const ChildRequest& request);

    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&& other) noexcept;
    // Kills the group and reaps, if still running; gives up after 5 seconds on a child that the
    // kernel does not let die (a hung network file system).
    ~ChildProcess();

    // Never blocks: takes what the child wrote, sends TERM and KILL when they are due, reaps.
    // True once the child has ended and its output is complete.
    bool poll();
    bool ended() const;

    // For the caller's ::poll() set, both POLLIN; -1 (which ::poll() skips) where there is nothing
    // to wait for. exit_fd is a pidfd: it tells the end of a child that closed its streams.
    int output_fd() const;
    int exit_fd() const;
    void add_poll_fds(std::vector<pollfd>& fds) const;  // both
    // The longest that ::poll() on both may sleep before poll() must be called for a deadline.
    int wait_milliseconds() const;

    // From now on; in place of an earlier one.
    void set_timeout(double seconds);

    int pid() const;  // also the number of its process group

    // So far, and after its end as in the result. CPU of the child alone, not of what it started.
    double wall_seconds() const;
    double cpu_seconds() const;
    // A regular file, for reading or writing. True too where that cannot be told: not by the
    // kernel, or of children of its own (a wrapper around the program).
    bool has_file_open() const;

    // stdout and stderr so far, in the order written. Of more than capture_limit bytes the first
    // and the last half are kept, and a line between them says so. Valid until the next poll().
    std::string_view output() const;

    // TERM now, KILL after the grace time, by later calls of poll(). Nothing where it has ended.
    void terminate();
    void kill_now();

    // Throws std::logic_error before poll() returned true.
    const ChildResult& result() const;

  private:
    class State;
    explicit ChildProcess(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// Blocks until the child has ended; `output` may be null. Throws as ChildProcess::start, and
// Failure(Exit::interrupted) after a signal (interrupt.h), when the child has been ended.
ChildResult run_to_end(const ChildRequest& request, std::string* output = nullptr);

// The guard's path: $MPIPOV_GUARD, or beside this executable, or where CMake installs it. Throws
// std::runtime_error saying where it was looked for.
std::filesystem::path find_guard();

}  // namespace mpipov
