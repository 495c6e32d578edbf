#include "user_settings.h"

#include <pwd.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>

namespace mpipov {

namespace fs = std::filesystem;

fs::path home_of_user() {
    const char* home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') return home;
    const passwd* entry = ::getpwuid(::getuid());
    return entry != nullptr && entry->pw_dir != nullptr ? entry->pw_dir : "";
}

fs::path settings_of_user(const fs::path& home) {
    std::error_code error;
    const char* named = std::getenv("POVINI");
    if (named != nullptr && fs::is_regular_file(named, error)) return fs::absolute(named, error);
    if (fs::exists("povray.ini", error)) return {};
    if (home.empty()) return {};
    fs::path own = home / ".povray/3.7/povray.ini";
    if (fs::is_regular_file(own, error)) return own;
    // The system's come before the older name of the user's.
    for (const char* systems :
         {"/etc/povray/3.7/povray.ini", "/usr/local/etc/povray/3.7/povray.ini"})
        if (fs::exists(systems, error)) return {};
    const fs::path older = home / ".povrayrc";
    return fs::is_regular_file(older, error) ? older : fs::path();
}

}  // namespace mpipov
