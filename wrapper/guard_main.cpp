// mpipov-guard PARENT-PID MEMORY-LIMIT FILE-SIZE-LIMIT -- PROGRAM [ARGUMENT...]
//
// Becomes PROGRAM, after asking the kernel to kill it when the parent dies and after setting its
// limits (bytes; 0: none). posix_spawn cannot do either. Needs no library: it runs before every
// launch of POV-Ray. Exits with 127 where it cannot become PROGRAM.

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

constexpr int cannot_start = 127;

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

}  // namespace

int main(int argc, char** argv) {
    if (argc < 6 || std::strcmp(argv[4], "--") != 0) {
        dprintf(STDERR_FILENO,
                "usage: mpipov-guard PARENT-PID MEMORY-LIMIT FILE-SIZE-LIMIT -- PROGRAM ...\n"
                "(started by mpipov, not by hand)\n");
        return cannot_start;
    }
    const unsigned long long parent = number(argv[1]);
    const unsigned long long memory = number(argv[2]);
    const unsigned long long file_size = number(argv[3]);
    char** const program = argv + 5;

    if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) fail("cannot guard", program[0], errno);
    // A parent that died before the prctl sends no signal any more.
    if (static_cast<unsigned long long>(getppid()) != parent) {
        fail("its parent is gone, not starting", program[0], ESRCH);
    }

    limit(RLIMIT_CORE, "core size", 0);
    if (file_size != 0) limit(RLIMIT_FSIZE, "file size", file_size);
    if (memory != 0) limit(RLIMIT_AS, "memory", memory);

    execvp(program[0], program);
    fail("cannot start", program[0], errno);
}
