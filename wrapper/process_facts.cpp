#include "process_facts.h"

#include "fd.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <ctime>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace mpipov {
namespace {

// So that a folder of very many empty files is full too.
constexpr std::uint64_t least_file_bytes = 4096;

std::string proc(pid_t process) {
    return "/proc/" + std::to_string(process);
}

// True too where the kernel does not tell.
bool has_children(pid_t process) {
    std::error_code error;
    const std::filesystem::directory_iterator threads(proc(process) + "/task", error);
    if (error) return true;
    return std::any_of(begin(threads), end(threads), [](const auto& thread) {
        std::ifstream children(thread.path() / "children");
        return !children || children.peek() != std::ifstream::traits_type::eof();
    });
}

}  // namespace

std::uint64_t peak_memory(pid_t process) {
    const Fd file(::open((proc(process) + "/status").c_str(), O_RDONLY | O_CLOEXEC));
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

double cpu_seconds_of(pid_t process) {
    clockid_t clock{};
    timespec spent{};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &spent) != 0)
        return 0;
    return static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec);
}

bool may_have_file_open(pid_t process) {
    std::error_code error;
    const std::filesystem::directory_iterator open(proc(process) + "/fd", error);
    if (error || has_children(process)) return true;
    return std::any_of(begin(open), end(open), [](const auto& file) {
        std::error_code ignored;  // one that was closed meanwhile
        return std::filesystem::status(file.path(), ignored).type() ==
               std::filesystem::file_type::regular;
    });
}

std::uint64_t disk_bytes_in(const std::filesystem::path& folder) {
    std::uint64_t sum = 0;
    std::error_code error;
    std::filesystem::recursive_directory_iterator it(folder, error);
    for (; !error && it != std::filesystem::recursive_directory_iterator(); it.increment(error)) {
        if (it->is_symlink(error)) continue;  // known without another look: there may be very many
        struct stat status {};
        const bool known = ::lstat(it->path().c_str(), &status) == 0;
        const auto bytes = known ? static_cast<std::uint64_t>(status.st_blocks) * 512 : 0;
        sum += std::max(bytes, least_file_bytes);
    }
    return sum;
}

}  // namespace mpipov
