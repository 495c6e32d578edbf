#include "guarded_spawn.h"

#include "installed_file.h"
#include "landlock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace mpipov {
namespace {

constexpr int ruleset_number = 3;  // as the guard has it

void check(int error, const std::string& what) {
    if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

class FileActions {
  public:
    explicit FileActions(const std::string& what) {
        check(posix_spawn_file_actions_init(&it_), what);
    }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
    ~FileActions() { posix_spawn_file_actions_destroy(&it_); }
    posix_spawn_file_actions_t* get() { return &it_; }

  private:
    posix_spawn_file_actions_t it_{};
};

class Attributes {
  public:
    explicit Attributes(const std::string& what) { check(posix_spawnattr_init(&it_), what); }
    Attributes(const Attributes&) = delete;
    Attributes& operator=(const Attributes&) = delete;
    ~Attributes() { posix_spawnattr_destroy(&it_); }
    posix_spawnattr_t* get() { return &it_; }

  private:
    posix_spawnattr_t it_{};
};

std::vector<std::string> merged_environment(const ChildRequest& request) {
    std::vector<std::string> result;
    for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
        const std::string_view text = *entry;
        const std::string_view name = text.substr(0, text.find('='));
        const bool replaced = std::any_of(request.environment.begin(), request.environment.end(),
                                          [&](const auto& added) { return added.first == name; });
        if (!replaced) result.emplace_back(text);
    }
    for (const auto& [name, value] : request.environment) {
        if (name.empty() || name.find('=') != std::string::npos) {
            throw std::invalid_argument(
                fmt::format("cannot start '{}': '{}' is no name of an environment variable",
                            request.argv.front(), name));
        }
        result.push_back(fmt::format("{}={}", name, value));
    }
    return result;
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
    std::vector<char*> result;
    result.reserve(strings.size() + 1);
    for (std::string& text : strings) result.push_back(text.data());
    result.push_back(nullptr);
    return result;
}

std::vector<std::string> guarded_argv(const std::filesystem::path& guard,
                                      const ChildRequest& request) {
    std::vector<std::string> argv{guard.string(),
                                  std::to_string(::getpid()),
                                  std::to_string(request.memory_limit_bytes.value_or(0)),
                                  std::to_string(request.file_size_limit_bytes.value_or(0)),
                                  request.files ? "restricted" : "free",
                                  "--"};
    argv.insert(argv.end(), request.argv.begin(), request.argv.end());
    std::string& program = argv[6];
    if (!request.working_directory.empty() && program.find('/') != std::string::npos) {
        program = std::filesystem::absolute(program).string();
    }
    return argv;
}

}  // namespace

Spawned spawn_guarded(const ChildRequest& request) {
    const std::string what = fmt::format("cannot start '{}'", request.argv.front());
    const std::filesystem::path guard = find_guard();
    std::error_code ignored;
    const std::filesystem::path& folder = request.working_directory;
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
        throw std::runtime_error(fmt::format("{}: its working directory '{}' is not a directory",
                                             what, folder.string()));
    }

    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) check(errno, what + ": no pipe");
    Spawned spawned;
    spawned.output = Fd(ends[0]);
    const Fd writer(ends[1]);
    if (::fcntl(spawned.output.get(), F_SETFL, O_NONBLOCK) != 0) check(errno, what + ": pipe");

    FileActions actions(what);
    auto* const a = actions.get();
    check(posix_spawn_file_actions_addopen(a, STDIN_FILENO, "/dev/null", O_RDONLY, 0), what);
    check(posix_spawn_file_actions_adddup2(a, writer.get(), STDOUT_FILENO), what);
    check(posix_spawn_file_actions_adddup2(a, writer.get(), STDERR_FILENO), what);
    Fd ruleset;
    if (request.files) {
        ruleset = make_ruleset(*request.files);
        // It may be the very number already, and dup2() to itself would leave it to be closed.
        ruleset = Fd(::fcntl(ruleset.get(), F_DUPFD_CLOEXEC, ruleset_number + 1));
        if (ruleset.get() < 0) check(errno, what + ": no descriptor");
        check(posix_spawn_file_actions_adddup2(a, ruleset.get(), ruleset_number), what);
    }
    // Libraries open descriptors without O_CLOEXEC, and mpiexec hands its own down.
    check(posix_spawn_file_actions_addclosefrom_np(
              a, (request.files ? ruleset_number : STDERR_FILENO) + 1),
          what);
    if (!folder.empty()) check(posix_spawn_file_actions_addchdir_np(a, folder.c_str()), what);

    Attributes attributes(what);
    sigset_t none{};
    sigset_t all{};
    sigemptyset(&none);
    sigfillset(&all);
    check(
        posix_spawnattr_setflags(attributes.get(), POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK |
                                                       POSIX_SPAWN_SETSIGDEF),
        what);
    check(posix_spawnattr_setpgroup(attributes.get(), 0), what);
    check(posix_spawnattr_setsigmask(attributes.get(), &none), what);
    check(posix_spawnattr_setsigdefault(attributes.get(), &all), what);

    std::vector<std::string> arguments = guarded_argv(guard, request);
    std::vector<std::string> environment = merged_environment(request);
    const std::vector<char*> argv = pointers(arguments);
    const std::vector<char*> envp = pointers(environment);
    check(::posix_spawn(&spawned.pid, guard.c_str(), a, attributes.get(), argv.data(), envp.data()),
          fmt::format("{} through '{}'", what, guard.string()));
    // glibc 2.36 declares pidfd_open() without extern "C". Where a kernel has no pidfd,
    // wait_milliseconds() makes up for it.
    spawned.exit = Fd(static_cast<int>(::syscall(SYS_pidfd_open, spawned.pid, 0)));
    return spawned;
}

std::filesystem::path find_guard() {
    return find_installed(
        {.name = "mpipov-guard", .folder = MPIPOV_LIBEXEC_FROM_BIN, .variable = "MPIPOV_GUARD"});
}

}  // namespace mpipov
