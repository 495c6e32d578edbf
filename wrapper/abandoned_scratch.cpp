#include "abandoned_scratch.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <ctime>
#include <regex>
#include <string>
#include <system_error>

namespace mpipov {
namespace {

constexpr mode_t marked_mode = S_IRWXU | S_ISUID;
constexpr long xfs_magic = 0x58465342;  // not in linux/magic.h

bool is_of_this_machine(int folder) {
    struct statfs status {};
    if (::fstatfs(folder, &status) != 0) return false;
    switch (status.f_type) {
        case TMPFS_MAGIC:
        case EXT4_SUPER_MAGIC:  // ext2 and ext3 too
        case BTRFS_SUPER_MAGIC:
        case OVERLAYFS_SUPER_MAGIC:
        case xfs_magic:
            return true;
        default:
            return false;
    }
}

bool is_ours_and_old(int folder, double seconds) {
    struct stat status {};
    return ::fstat(folder, &status) == 0 && status.st_uid == ::geteuid() &&
           (status.st_mode & 07777) == marked_mode &&
           std::difftime(std::time(nullptr), status.st_ctime) >= seconds;
}

Fd locked(const std::filesystem::path& folder) {
    Fd fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (fd.get() >= 0 && ::flock(fd.get(), LOCK_EX | LOCK_NB) != 0) fd.reset();
    return fd;
}

}  // namespace

bool is_scratch_name(const std::string& name) {
    // The last letters are mkdtemp()'s.
    static const std::regex shape("mpipov-[a-z0-9]+\\.[A-Za-z0-9]{6}");
    return std::regex_match(name, shape);
}

Fd hold(const std::filesystem::path& folder) {
    Fd fd = locked(folder);
    if (fd.get() >= 0 && is_of_this_machine(fd.get())) ::fchmod(fd.get(), marked_mode);
    return fd;
}

void remove_abandoned_scratch(const std::filesystem::path& base, double seconds) {
    std::error_code error;
    std::filesystem::directory_iterator it(base, error);
    for (; !error && it != std::filesystem::directory_iterator(); it.increment(error)) {
        const std::filesystem::path& path = it->path();
        if (!is_scratch_name(path.filename().string())) continue;
        const Fd held = locked(path);  // until it is gone: of two processes one removes it
        if (held.get() < 0 || !is_of_this_machine(held.get()) ||
            !is_ours_and_old(held.get(), seconds))
            continue;
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
}

}  // namespace mpipov
