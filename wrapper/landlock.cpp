#include "landlock.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <system_error>

namespace mpipov {
namespace {

// Later than Debian 12's header.
constexpr std::uint64_t access_truncate = 1ULL << 14;
constexpr std::uint64_t access_ioctl_device = 1ULL << 15;

constexpr std::uint64_t reading = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
// POV-Ray makes regular files and nothing else: no links, no devices, no sockets.
constexpr std::uint64_t writing = reading | LANDLOCK_ACCESS_FS_WRITE_FILE |
                                  LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE |
                                  LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
                                  access_truncate;
constexpr std::uint64_t executing = reading | LANDLOCK_ACCESS_FS_EXECUTE;
constexpr std::uint64_t of_files = LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE |
                                   LANDLOCK_ACCESS_FS_READ_FILE | access_truncate;

// 0 where there is none.
long landlock_version() {
    return std::max(
        0L, ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION));
}

// All that a kernel of this version can forbid.
std::uint64_t known_to(long version) {
    std::uint64_t known = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;
    if (version >= 2) known |= LANDLOCK_ACCESS_FS_REFER;
    if (version >= 3) known |= access_truncate;
    if (version >= 5) known |= access_ioctl_device;
    return known;
}

void allow(const Fd& ruleset, const std::vector<std::filesystem::path>& paths,
           std::uint64_t rights) {
    for (const std::filesystem::path& path : paths) {
        // A link that took the place of what was allowed leads nowhere.
        const Fd file(::open(path.c_str(), O_PATH | O_CLOEXEC | O_NOFOLLOW));
        struct stat status {};
        // What we cannot reach, what we start cannot reach either.
        if (file.get() < 0 || ::fstat(file.get(), &status) != 0 || S_ISLNK(status.st_mode))
            continue;
        landlock_path_beneath_attr rule{};
        rule.allowed_access = S_ISDIR(status.st_mode) ? rights : rights & of_files;
        rule.parent_fd = file.get();
        if (::syscall(SYS_landlock_add_rule, ruleset.get(), LANDLOCK_RULE_PATH_BENEATH, &rule, 0) !=
            0)
            throw std::system_error(errno, std::generic_category(),
                                    "cannot allow access to '" + path.string() + "'");
    }
}

}  // namespace

bool can_restrict_files() {
    return landlock_version() > 0;
}

void resolve_links(FileAccess& access) {
    for (auto* paths : {&access.read, &access.write, &access.execute})
        for (std::filesystem::path& path : *paths) {
            std::error_code error;
            const std::filesystem::path parent = path.parent_path();
            const bool everybodys =
                (std::filesystem::status(parent, error).permissions() &
                 std::filesystem::perms::sticky_bit) != std::filesystem::perms::none;
            if (const std::filesystem::path real = std::filesystem::canonical(path, error);
                !error && !everybodys)
                path = real;
        }
}

Fd make_ruleset(const FileAccess& access) {
    const std::uint64_t known = known_to(landlock_version());
    landlock_ruleset_attr attributes{};
    attributes.handled_access_fs = known;
    Fd ruleset(static_cast<int>(
        ::syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0)));
    if (ruleset.get() < 0)
        throw std::system_error(errno, std::generic_category(), "cannot restrict access to files");
    allow(ruleset, access.read, reading & known);
    allow(ruleset, access.write, writing & known);
    allow(ruleset, access.execute, executing & known);
    return ruleset;
}

}  // namespace mpipov
