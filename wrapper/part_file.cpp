#include "part_file.h"

#include "failure.h"
#include "fd.h"
#include "interrupt.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <random>
#include <system_error>
#include <thread>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

constexpr int pause_milliseconds = 50;

[[noreturn]] void refuse(const fs::path& target, const std::string& why) {
    throw Failure(Exit::file, fmt::format("cannot write '{}': {}", target.string(), why));
}

// Opening a pipe waits for its reader, and writing for that to read: a user must be able to
// interrupt both.
Fd open_to_write_into(const fs::path& target) {
    constexpr auto pause = std::chrono::milliseconds(pause_milliseconds);
    for (;;) {
        Fd file(::open(target.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
        if (file.get() >= 0) return file;
        if (errno != ENXIO || !fs::is_fifo(target)) refuse(target, std::strerror(errno));
        throw_if_interrupted();
        std::this_thread::sleep_for(pause);
    }
}

void write_all(const Fd& out, std::string_view bytes, const fs::path& target) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(out.get(), bytes.data(), bytes.size());
        if (written >= 0) {
            bytes.remove_prefix(static_cast<std::size_t>(written));
            continue;
        }
        if (errno != EAGAIN) refuse(target, std::strerror(errno));
        throw_if_interrupted();
        pollfd room{out.get(), POLLOUT, 0};
        ::poll(&room, 1, pause_milliseconds);
    }
}

}  // namespace

bool is_written_into(const fs::path& target) {
    std::error_code error;
    const fs::file_status status = fs::status(target, error);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

// Not fs::canonical: what the last link names need not be there yet.
fs::path end_of_links(const fs::path& file) {
    constexpr int most = 40;  // as Linux
    fs::path end = file;
    std::error_code error;
    for (int followed = 0; fs::is_symlink(fs::symlink_status(end, error)); ++followed) {
        if (followed == most) refuse(file, std::strerror(ELOOP));
        const fs::path next = fs::read_symlink(end, error);
        if (error) refuse(file, error.message());
        end = end.parent_path() / next;
    }
    return end;
}

PartFile::PartFile(const fs::path& target)
    // /dev/fd/5 is a link to what has no name: it is asked for first.
    : into_(is_written_into(target)), target_(into_ ? target : end_of_links(target)) {
    if (into_ && ::access(target_.c_str(), W_OK) != 0) refuse(target, std::strerror(errno));
    const fs::path folder = into_ ? fs::temp_directory_path() : target_.parent_path();
    std::random_device random;
    for (;;) {
        part_ = folder / fmt::format(".mpipov-{:08x}", random());
        // Not mkstemp: the file is to have the access rights that any new file has.
        const int file = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file >= 0) {
            ::close(file);
            return;
        }
        if (errno != EEXIST) refuse(target, std::strerror(errno));
    }
}

PartFile::~PartFile() {
    std::error_code ignored;
    if (!part_.empty()) fs::remove(part_, ignored);
}

void PartFile::take_place() {
    if (into_) {
        write_into_place();
        return;
    }
    std::error_code error;
    fs::rename(part_, target_, error);
    if (error) refuse(target_, error.message());
    part_.clear();
}

void PartFile::write_into_place() const {
    const Fd in(::open(part_.c_str(), O_RDONLY | O_CLOEXEC));
    if (in.get() < 0) refuse(part_, std::strerror(errno));
    const Fd out = open_to_write_into(target_);
    std::array<char, 1 << 16> bytes{};
    for (;;) {
        const ssize_t got = ::read(in.get(), bytes.data(), bytes.size());
        if (got == 0) return;
        if (got < 0) refuse(target_, std::strerror(errno));
        write_all(out, {bytes.data(), static_cast<std::size_t>(got)}, target_);
    }
}

void write_whole(const fs::path& target, std::string_view text) {
    PartFile part(target);
    std::ofstream out(part.path());
    out << text;
    if (!out.flush()) refuse(target, std::strerror(errno));
    part.take_place();
}

}  // namespace mpipov
