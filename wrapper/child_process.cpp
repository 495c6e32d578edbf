#include "child_process.h"

#include "bounded_text.h"
#include "cpu_time.h"
#include "guarded_spawn.h"
#include "interrupt.h"
#include "process_facts.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <stdexcept>

namespace mpipov {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double reap_seconds = 5;    // how long the destructor waits after KILL
constexpr double idle_seconds = 0.1;  // so that memory is sampled now and then
constexpr double idle_seconds_without_pidfd = 0.01;
constexpr double sample_seconds = 0.05;  // between two looks at the child's memory
constexpr double folder_seconds = 0.2;   // and at its folder
constexpr std::size_t drain_limit = 1
                                    << 20;  // bytes one poll() takes: a chatterbox must not hold us

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
    void set_timeout(double seconds) { timeout_ = elapsed() + seconds; }
    int pid() const { return pid_; }
    std::string_view output() { return text_.view(); }
    double wall_seconds() const { return ended_ ? result_.wall_seconds : elapsed(); }
    double cpu_seconds() const;
    bool has_file_open() const;
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
    void look_at_folder();
    void enforce_deadlines();

    Clock::time_point start_ = Clock::now();
    std::optional<double> timeout_;  // these three: seconds since start_
    std::optional<double> kill_at_;
    double next_sample_ = 0, next_look_at_folder_ = 0;
    std::optional<FolderLimit> folder_limit_;
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
      folder_limit_(request.folder_limit),
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
    own_peak_ = peak_memory(::getpid());
    start_ = Clock::now();
    Spawned spawned = spawn_guarded(request);
    pid_ = spawned.pid;
    pipe_ = std::move(spawned.output);
    pidfd_ = std::move(spawned.exit);
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
        result_.cpu_seconds = mpipov::cpu_seconds(usage);
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
    sampled_peak_ = std::max(sampled_peak_, peak_memory(pid_));
}

void ChildProcess::State::look_at_folder() {
    if (!folder_limit_ || kill_at_ || elapsed() < next_look_at_folder_) return;
    next_look_at_folder_ = elapsed() + folder_seconds;
    if (disk_bytes_in(folder_limit_->folder) <= folder_limit_->bytes) return;
    result_.filled_folder = true;
    begin_termination();
}

double ChildProcess::State::cpu_seconds() const {
    return ended_ ? result_.cpu_seconds : cpu_seconds_of(pid_);
}

bool ChildProcess::State::has_file_open() const {
    return !ended_ && may_have_file_open(pid_);
}

void ChildProcess::State::begin_termination() {
    if (kill_at_) return;
    kill_at_ = elapsed() + grace_;
    signal_group(SIGTERM);
}

void ChildProcess::State::enforce_deadlines() {
    if (!kill_at_ && timeout_ && elapsed() >= *timeout_) {
        result_.timed_out = true;
        result_.timeout_seconds = *timeout_;
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
    look_at_folder();
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

void ChildProcess::add_poll_fds(std::vector<pollfd>& fds) const {
    fds.push_back({output_fd(), POLLIN, 0});
    fds.push_back({exit_fd(), POLLIN, 0});
}
int ChildProcess::wait_milliseconds() const {
    return state_->wait_milliseconds();
}
void ChildProcess::set_timeout(double seconds) {
    state_->set_timeout(seconds);
}
int ChildProcess::pid() const {
    return state_->pid();
}
double ChildProcess::wall_seconds() const {
    return state_->wall_seconds();
}
double ChildProcess::cpu_seconds() const {
    return state_->cpu_seconds();
}
bool ChildProcess::has_file_open() const {
    return state_->has_file_open();
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
        throw_if_interrupted();
        std::array<pollfd, 2> set{{{child.output_fd(), POLLIN, 0}, {child.exit_fd(), POLLIN, 0}}};
        ::poll(set.data(), set.size(), child.wait_milliseconds());
    }
    if (output != nullptr) *output = child.output();
    return child.result();
}

}  // namespace mpipov
