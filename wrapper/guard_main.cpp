// mpipov-guard PARENT-PID MEMORY-LIMIT FILE-SIZE-LIMIT FILES -- PROGRAM [ARGUMENT...]
//
// Becomes PROGRAM, after asking the kernel to kill it when the parent dies and after setting its
// limits (bytes; 0: none). With FILES "restricted", descriptor 3 is a Landlock ruleset that
// PROGRAM is held to ever after (landlock.h); else "free". posix_spawn cannot do any of this. Needs
// no library: it runs before every launch of POV-Ray. Exits with 127 where it cannot become
// PROGRAM.

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
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

    limit(RLIMIT_CORE, "core size", 0);
    if (file_size != 0) limit(RLIMIT_FSIZE, "file size", file_size);
    // Not of address space: every thread reserves far more of that than it uses.
    if (memory != 0) limit(RLIMIT_DATA, "memory", memory);
    offer_to_the_kernel();
    if (std::strcmp(argv[4], "restricted") == 0) restrict_files(program[0]);

    execvp(program[0], program);
    fail("cannot start", program[0], errno);
}
