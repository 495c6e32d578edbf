// mpipov-guard PARENT-PID MEMORY-LIMIT FILE-SIZE-LIMIT FILES -- PROGRAM [ARGUMENT...]
//
// Becomes PROGRAM, after asking the kernel to kill it when the parent dies and after setting its
// limits (bytes; 0: none). With FILES "restricted", descriptor 3 is a Landlock ruleset that
// PROGRAM is held to ever after (landlock.h); else "free". posix_spawn cannot do any of this. Needs
// no library: it runs before every launch of POV-Ray. Exits with 127 where it cannot become
// PROGRAM.
//
// The kernel kills PROGRAM alone. Where that is a script, it may have started POV-Ray as a child,
// so a second guard stays behind for it: it kills the process group when the parent dies.

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

constexpr int cannot_start = 127;
constexpr int ruleset = 3;

[[noreturn]] void fail(const char* what, const char* name, int error) {
    dprintf(STDERR_FILENO, "mpipov: %s '%s': %s\n", what, name, std::strerror(error));
    _exit(cannot_start);
}

unsigned long long number(const char* text) {
    char* end = nullptr;
    errno = 0;
    const unsigned long long value = std::strtoull(text, &end, 10);
    if (errno != 0 || end == text || *end != '\0') fail("not a number", text, EINVAL);
    return value;
}

// Limits only ever get tighter: one that was set on us stays.
void limit(__rlimit_resource_t resource, const char* name, rlim_t bytes) {
    rlimit now{};
    if (getrlimit(resource, &now) != 0) fail("cannot read the limit", name, errno);
    if (bytes < now.rlim_max) now.rlim_max = bytes;
    if (now.rlim_max < now.rlim_cur) now.rlim_cur = now.rlim_max;
    if (setrlimit(resource, &now) != 0) fail("cannot set the limit", name, errno);
}

// Where memory runs out the kernel ends a scene, and not what the user works with.
void offer_to_the_kernel() {
    const int file = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
    if (file < 0) return;
    [[maybe_unused]] const ssize_t ignored = write(file, "1000", 4);
    close(file);
}

void restrict_files(const char* program) {
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        syscall(SYS_landlock_restrict_self, ruleset, 0) != 0)
        fail("cannot restrict the files of", program, errno);
    close(ruleset);
}

// Also one without "#!", which execvp() hands to the shell.
bool is_no_machine_code(const char* file) {
    constexpr std::array<char, 4> elf{'\x7f', 'E', 'L', 'F'};
    std::array<char, 4> begin{};
    const int descriptor = access(file, X_OK) == 0 ? open(file, O_RDONLY | O_CLOEXEC) : -1;
    if (descriptor < 0) return false;
    const ssize_t count = read(descriptor, begin.data(), begin.size());
    close(descriptor);
    return count >= 0 && begin != elf;
}

// As execvp() finds it.
bool is_script(const char* program) {
    if (std::strchr(program, '/') != nullptr) return is_no_machine_code(program);
    const char* path = std::getenv("PATH");
    for (const char* folder = path == nullptr ? "/bin:/usr/bin" : path; *folder != '\0';) {
        const auto length = static_cast<int>(std::strcspn(folder, ":"));
        std::array<char, PATH_MAX> file{};
        const int written =
            std::snprintf(file.data(), file.size(), "%.*s/%s", length, folder, program);
        if (written > 0 && static_cast<std::size_t>(written) < file.size() &&
            access(file.data(), X_OK) == 0)
            return is_no_machine_code(file.data());
        folder += length;
        if (*folder == ':') ++folder;
    }
    return false;
}

pollfd end_of(pid_t process) {
    return {static_cast<int>(syscall(SYS_pidfd_open, process, 0)), POLLIN, 0};
}

void wait_for(pollfd* processes, nfds_t count, int milliseconds) {
    while (poll(processes, count, milliseconds) < 0 && errno == EINTR) {
    }
}

// Until either is gone; the group goes with the parent. Not in the group itself, whose end is
// waited for; the launch's output is not its own.
[[noreturn]] void stay_behind(std::array<pollfd, 2> ends, pid_t group) {
    setsid();
    for (int descriptor = 0; descriptor < ruleset; ++descriptor) close(descriptor);
    pollfd* const parent = ends.data();
    wait_for(parent, ends.size(), -1);
    // PROGRAM, which the kernel kills with the thread that started it, may be gone long before all
    // of the parent is.
    constexpr int moment = 50;
    while (parent->revents == 0 && kill(-group, 0) == 0) wait_for(parent, 1, moment);
    if (parent->revents != 0) kill(-group, SIGKILL);
    _exit(0);
}

// By a process between, so that PROGRAM has no child that it did not start. Where the kernel has no
// pidfd, or no process is to be had, there is none.
void leave_one_behind(pid_t parent) {
    const pid_t program = getpid();
    // Before anything of PROGRAM can be seen: who is gone then has no descriptor any more.
    const std::array<pollfd, 2> ends{end_of(parent), end_of(program)};
    if (ends[0].fd < 0 || ends[1].fd < 0) return;
    const pid_t between = fork();
    if (between == 0) {
        if (fork() == 0) stay_behind(ends, program);
        _exit(0);
    }
    if (between > 0) waitpid(between, nullptr, 0);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 7 || std::strcmp(argv[5], "--") != 0) {
        dprintf(STDERR_FILENO,
                "usage: mpipov-guard PARENT-PID MEMORY-LIMIT FILE-SIZE-LIMIT restricted|free -- "
                "PROGRAM ...\n"
                "(started by mpipov, not by hand)\n");
        return cannot_start;
    }
    const unsigned long long parent = number(argv[1]);
    const unsigned long long memory = number(argv[2]);
    const unsigned long long file_size = number(argv[3]);
    char** const program = argv + 6;

    if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) fail("cannot guard", program[0], errno);
    // A parent that died before the prctl sends no signal any more.
    if (static_cast<unsigned long long>(getppid()) != parent) {
        fail("its parent is gone, not starting", program[0], ESRCH);
    }

    if (is_script(program[0])) leave_one_behind(static_cast<pid_t>(parent));

    limit(RLIMIT_CORE, "core size", 0);
    if (file_size != 0) limit(RLIMIT_FSIZE, "file size", file_size);
    // Not of address space: every thread reserves far more of that than it uses.
    if (memory != 0) limit(RLIMIT_DATA, "memory", memory);
    offer_to_the_kernel();
    if (std::strcmp(argv[4], "restricted") == 0) restrict_files(program[0]);

    execvp(program[0], program);
    fail("cannot start", program[0], errno);
}
