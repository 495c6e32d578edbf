#include "child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <system_error>

namespace mpipov {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double reap_seconds = 5;    // how long the destructor waits after KILL
constexpr double idle_seconds = 0.1;  // so that memory is sampled now and then
constexpr double idle_seconds_without_pidfd = 0.01;
constexpr double sample_seconds = 0.05;  // between two looks at the child's memory
constexpr std::size_t drain_limit = 1
                                    << 20;  // bytes one poll() takes: a chatterbox must not hold us

class Fd {
  public:
    explicit Fd(int fd = -1) : fd_(fd) {}
    Fd(Fd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Fd& operator=(Fd&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    ~Fd() { reset(); }

    int get() const { return fd_; }
    void reset() {
        if (fd_ >= 0) ::close(fd_);
        fd_ = -1;
    }

  private:
    int fd_;
};

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

// Keeps the first and the last half of what is appended, once that is more than the limit.
class BoundedText {
  public:
    explicit BoundedText(std::size_t limit)
        : limit_(limit),
          marker_(
              fmt::format("\n[mpipov: more than {} bytes of output, middle left out]\n", limit)) {}

    void append(std::string_view more) {
        text_ += more;
        if (!cut_ && text_.size() > limit_) {
            text_.insert(limit_ / 2, marker_);
            cut_ = true;
        }
        // Moving the tail only now and then keeps the cost linear.
        if (cut_ && text_.size() > 2 * limit_ + marker_.size()) trim();
    }

    std::string_view view() {
        if (cut_) trim();
        return text_;
    }

  private:
    void trim() {
        const std::size_t most = limit_ + marker_.size();
        if (text_.size() > most) text_.erase(limit_ / 2 + marker_.size(), text_.size() - most);
    }

    std::size_t limit_;
    std::string marker_, text_;
    bool cut_ = false;
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
    std::vector<std::string> argv{guard.string(), std::to_string(::getpid()),
                                  std::to_string(request.memory_limit_bytes.value_or(0)),
                                  std::to_string(request.file_size_limit_bytes.value_or(0)), "--"};
    argv.insert(argv.end(), request.argv.begin(), request.argv.end());
    std::string& program = argv[5];
    if (!request.working_directory.empty() && program.find('/') != std::string::npos) {
        program = std::filesystem::absolute(program).string();
    }
    return argv;
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

// The largest resident set since exec, bytes; 0 where /proc does not tell (a zombie has none).
std::uint64_t peak_memory(const std::string& process) {
    const Fd file(::open(("/proc/" + process + "/status").c_str(), O_RDONLY | O_CLOEXEC));
    std::array<char, 4096> buffer{};
    const ssize_t size = file.get() < 0 ? 0 : ::read(file.get(), buffer.data(), buffer.size());
    if (size <= 0) return 0;
    std::string_view text(buffer.data(), static_cast<std::size_t>(size));
    constexpr std::string_view key = "VmHWM:";
    const std::size_t at = text.find(key);
    if (at == std::string_view::npos) return 0;
    text.remove_prefix(at + key.size());
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    std::uint64_t kibibytes = 0;
    std::from_chars(text.data(), text.data() + text.size(), kibibytes);
    return kibibytes * 1024;
}

}  // namespace

class ChildProcess::State {
  public:
    explicit State(const ChildRequest& request);
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State();

    void spawn(const ChildRequest& request);
    bool poll();
    bool ended() const { return ended_; }
    int output_fd() const { return pipe_.get(); }
    int exit_fd() const { return pidfd_.get(); }
    int wait_milliseconds() const;
    int pid() const { return pid_; }
    std::string_view output() { return text_.view(); }
    void terminate();
    void kill_now();
    const ChildResult& result() const { return result_; }

  private:
    double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    // Until the leader is reaped, its number cannot belong to anyone else's group.
    void signal_group(int signal) const {
        if (!lost_) ::kill(-pid_, signal);
    }
    void begin_termination();
    void drain();
    bool has_exited();
    void reap();
    void sample_memory();
    void enforce_deadlines();

    Clock::time_point start_ = Clock::now();
    std::optional<double> timeout_;  // these three: seconds since start_
    std::optional<double> kill_at_;
    double next_sample_ = 0;
    double grace_;
    pid_t pid_ = -1;
    Fd pipe_, pidfd_;
    BoundedText text_;
    ChildResult result_;
    std::uint64_t own_peak_ = 0, sampled_peak_ = 0;
    bool killed_ = false, ended_ = false, lost_ = false;
};

ChildProcess::State::State(const ChildRequest& request)
    : timeout_(request.timeout_seconds),
      grace_(request.grace_seconds),
      text_(request.capture_limit) {}

ChildProcess::State::~State() {
    if (pid_ < 0 || ended_) return;
    signal_group(SIGKILL);
    const double give_up = elapsed() + reap_seconds;
    while (!has_exited() && elapsed() < give_up) {
        pollfd end{pidfd_.get(), POLLIN, 0};  // without a pidfd this just sleeps
        ::poll(&end, 1, 10);
    }
    signal_group(SIGKILL);
    rusage usage{};
    int status = 0;
    ::wait4(pid_, &status, WNOHANG, &usage);
}

void ChildProcess::State::spawn(const ChildRequest& request) {
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
    pipe_ = Fd(ends[0]);
    const Fd writer(ends[1]);
    if (::fcntl(pipe_.get(), F_SETFL, O_NONBLOCK) != 0) check(errno, what + ": pipe");

    FileActions actions(what);
    auto* const a = actions.get();
    check(posix_spawn_file_actions_addopen(a, STDIN_FILENO, "/dev/null", O_RDONLY, 0), what);
    check(posix_spawn_file_actions_adddup2(a, writer.get(), STDOUT_FILENO), what);
    check(posix_spawn_file_actions_adddup2(a, writer.get(), STDERR_FILENO), what);
    // Libraries open descriptors without O_CLOEXEC, and mpiexec hands its own down.
    check(posix_spawn_file_actions_addclosefrom_np(a, STDERR_FILENO + 1), what);
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
    own_peak_ = peak_memory("self");
    start_ = Clock::now();
    pid_t pid = -1;
    check(::posix_spawn(&pid, guard.c_str(), a, attributes.get(), argv.data(), envp.data()),
          fmt::format("{} through '{}'", what, guard.string()));
    pid_ = pid;
    // glibc 2.36 declares pidfd_open() without extern "C". Where a kernel has no pidfd,
    // wait_milliseconds() makes up for it.
    pidfd_ = Fd(static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0)));
}

void ChildProcess::State::drain() {
    std::array<char, 65536> buffer{};
    std::size_t taken = 0;
    while (pipe_.get() >= 0 && taken < drain_limit) {
        const ssize_t size = ::read(pipe_.get(), buffer.data(), buffer.size());
        if (size > 0) {
            text_.append({buffer.data(), static_cast<std::size_t>(size)});
            taken += static_cast<std::size_t>(size);
        } else if (size < 0 && errno == EINTR) {
            continue;
        } else if (size < 0 && errno == EAGAIN) {
            return;
        } else {
            pipe_.reset();  // end of file
        }
    }
}

// Leaves it a zombie. Also true where it is lost: somebody else has reaped it.
bool ChildProcess::State::has_exited() {
    siginfo_t info{};
    int status = 0;
    do {
        status = ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
    } while (status != 0 && errno == EINTR);
    lost_ = status != 0;
    return lost_ || info.si_pid == pid_;
}

void ChildProcess::State::reap() {
    signal_group(SIGKILL);
    rusage usage{};
    int status = 0;
    pid_t reaped = -1;
    do {
        reaped = ::wait4(pid_, &status, 0, &usage);
    } while (reaped < 0 && errno == EINTR);
    ended_ = true;
    result_.wall_seconds = elapsed();
    result_.max_rss_bytes = sampled_peak_;
    if (reaped == pid_) {
        if (WIFEXITED(status)) result_.exit_code = WEXITSTATUS(status);
        if (WIFSIGNALED(status)) result_.signal = WTERMSIG(status);
        result_.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
        // Both counters are approximate to some pages a core, hence the quarter.
        const std::uint64_t peak = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
        if (peak > own_peak_ + own_peak_ / 4) result_.max_rss_bytes = std::max(peak, sampled_peak_);
    }
    drain();
    pipe_.reset();
    pidfd_.reset();
}

void ChildProcess::State::sample_memory() {
    if (elapsed() < next_sample_) return;
    next_sample_ = elapsed() + sample_seconds;
    sampled_peak_ = std::max(sampled_peak_, peak_memory(std::to_string(pid_)));
}

void ChildProcess::State::begin_termination() {
    if (kill_at_) return;
    kill_at_ = elapsed() + grace_;
    signal_group(SIGTERM);
}

void ChildProcess::State::enforce_deadlines() {
    if (!kill_at_ && timeout_ && elapsed() >= *timeout_) {
        result_.timed_out = true;
        begin_termination();
    }
    if (kill_at_ && !killed_ && elapsed() >= *kill_at_) {
        killed_ = true;
        signal_group(SIGKILL);
    }
}

bool ChildProcess::State::poll() {
    if (ended_) return true;
    drain();
    if (has_exited()) {
        reap();
        return true;
    }
    sample_memory();
    enforce_deadlines();
    return false;
}

int ChildProcess::State::wait_milliseconds() const {
    if (ended_) return 0;
    double wait = pidfd_.get() >= 0 ? idle_seconds : idle_seconds_without_pidfd;
    const std::optional<double>& due = kill_at_ ? kill_at_ : timeout_;
    if (due && !killed_) wait = std::clamp(*due - elapsed(), 0.0, wait);
    return static_cast<int>(std::ceil(wait * 1000));
}

void ChildProcess::State::terminate() {
    if (ended_) return;
    result_.cancelled = true;
    begin_termination();
}

void ChildProcess::State::kill_now() {
    if (ended_) return;
    result_.cancelled = true;
    kill_at_ = elapsed();
    killed_ = true;
    signal_group(SIGKILL);
}

ChildProcess ChildProcess::start(const ChildRequest& request) {
    if (request.argv.empty() || request.argv.front().empty()) {
        throw std::invalid_argument("no program to start: the argument list is empty");
    }
    auto state = std::make_unique<State>(request);
    state->spawn(request);
    return ChildProcess(std::move(state));
}

ChildProcess::ChildProcess(std::unique_ptr<State> state) : state_(std::move(state)) {}
ChildProcess::ChildProcess(ChildProcess&& other) noexcept = default;
ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept = default;
ChildProcess::~ChildProcess() = default;

bool ChildProcess::poll() {
    return state_->poll();
}
bool ChildProcess::ended() const {
    return state_->ended();
}
int ChildProcess::output_fd() const {
    return state_->output_fd();
}
int ChildProcess::exit_fd() const {
    return state_->exit_fd();
}
int ChildProcess::wait_milliseconds() const {
    return state_->wait_milliseconds();
}
int ChildProcess::pid() const {
    return state_->pid();
}
std::string_view ChildProcess::output() const {
    return state_->output();
}
void ChildProcess::terminate() {
    state_->terminate();
}
void ChildProcess::kill_now() {
    state_->kill_now();
}

const ChildResult& ChildProcess::result() const {
    if (!state_->ended()) throw std::logic_error("ChildProcess::result() before the child ended");
    return state_->result();
}

ChildResult run_to_end(const ChildRequest& request, std::string* output) {
    ChildProcess child = ChildProcess::start(request);
    while (!child.poll()) {
        std::array<pollfd, 2> set{{{child.output_fd(), POLLIN, 0}, {child.exit_fd(), POLLIN, 0}}};
        ::poll(set.data(), set.size(), child.wait_milliseconds());
    }
    if (output != nullptr) *output = child.output();
    return child.result();
}

std::filesystem::path find_guard() {
    namespace fs = std::filesystem;
    if (const char* named = std::getenv("MPIPOV_GUARD"); named != nullptr && *named != '\0') {
        if (::access(named, X_OK) == 0) return fs::absolute(named);
        throw std::runtime_error(fmt::format(
            "MPIPOV_GUARD names '{}', which is no executable file: correct or unset it", named));
    }
    const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
    const std::array<fs::path, 2> places{
        here / "mpipov-guard", here.parent_path() / "libexec" / "mpipov" / "mpipov-guard"};
    for (const fs::path& place : places) {
        if (::access(place.c_str(), X_OK) == 0) return place;
    }
    throw std::runtime_error(fmt::format(
        "cannot find mpipov-guard, neither as '{}' nor as '{}': build or install it with mpipov, "
        "or let MPIPOV_GUARD name it",
        places[0].string(), places[1].string()));
}

}  // namespace mpipov
