#include "program_files.h"

#include <elf.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

constexpr std::array libraries{"/lib",
                               "/lib32",
                               "/lib64",
                               "/usr/lib",
                               "/usr/lib32",
                               "/usr/lib64",
                               "/usr/local/lib",
                               "/usr/local/lib64",
                               "/etc/ld.so.cache",
                               "/etc/ld.so.conf",
                               "/etc/ld.so.conf.d",
                               "/etc/ld.so.preload"};
constexpr std::array anybodys{"/dev/zero",
                              "/dev/random",
                              "/dev/urandom",
                              "/etc/localtime",
                              "/usr/share/zoneinfo",
                              "/usr/share/locale",
                              "/usr/share/fonts",
                              "/usr/local/share/fonts",
                              "/sys/devices/system/cpu"};
// What a script may be made of.
constexpr std::array programs{"/bin", "/sbin", "/usr", "/opt", "/etc"};

std::vector<std::string_view> split(std::string_view text, char at) {
    std::vector<std::string_view> parts;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(at), text.size());
        parts.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return parts;
}

std::string_view variable(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? std::string_view() : value;
}

bool can_run(const fs::path& file) {
    std::error_code error;
    return fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0;
}

// The dynamic loader, which the kernel runs for a program; empty where it needs none. Nothing where
// the file is no program of this machine's kind.
std::optional<fs::path> loader_of(const fs::path& program) {
    std::ifstream in(program, std::ios::binary);
    Elf64_Ehdr head{};
    if (!in.read(reinterpret_cast<char*>(&head), sizeof head) ||
        std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_ident[EI_CLASS] != ELFCLASS64 ||
        head.e_phentsize != sizeof(Elf64_Phdr))
        return {};
    for (int i = 0; i < head.e_phnum; ++i) {
        Elf64_Phdr part{};
        in.seekg(static_cast<std::streamoff>(head.e_phoff + i * sizeof part));
        if (!in.read(reinterpret_cast<char*>(&part), sizeof part)) return {};
        if (part.p_type != PT_INTERP || part.p_filesz > 4096) continue;
        std::string name(part.p_filesz, '\0');
        in.seekg(static_cast<std::streamoff>(part.p_offset));
        if (!in.read(name.data(), static_cast<std::streamsize>(name.size()))) return {};
        return name.c_str();  // it ends in a zero byte
    }
    return fs::path();
}

void add_povrays_own(const fs::path& prefix, std::vector<fs::path>& read) {
    std::error_code error;
    for (fs::directory_iterator it(prefix / "share", error);
         !error && it != fs::directory_iterator(); it.increment(error))
        if (it->path().filename().string().rfind("povray", 0) == 0) read.push_back(it->path());
    for (const char* own : {"share/doc/povray", "etc/povray", "lib", "lib64"})
        read.push_back(prefix / own);
}

}  // namespace

fs::path find_program(const std::string& program) {
    std::error_code error;
    if (program.find('/') != std::string::npos)
        return can_run(program) ? fs::absolute(program, error) : fs::path();
    for (const std::string_view folder : split(variable("PATH"), ':')) {
        const fs::path file = fs::path(folder.empty() ? "." : folder) / program;
        if (can_run(file)) return fs::absolute(file, error);
    }
    return {};
}

FileAccess files_of_program(const fs::path& program) {
    FileAccess access;
    access.write = {"/dev/null"};
    access.read.assign(libraries.begin(), libraries.end());
    access.read.insert(access.read.end(), anybodys.begin(), anybodys.end());
    for (const std::string_view folder : split(variable("LD_LIBRARY_PATH"), ':'))
        if (!folder.empty()) access.read.emplace_back(folder);  // empty: the current folder
    for (const char* prefix : {"/usr", "/usr/local"}) add_povrays_own(prefix, access.read);
    access.read.emplace_back("/etc/povray");
    if (program.empty()) return access;
    access.execute.push_back(program);
    std::error_code error;
    add_povrays_own(fs::weakly_canonical(program, error).parent_path().parent_path(), access.read);
    if (const auto loader = loader_of(program)) {
        access.execute.push_back(*loader);
        return access;
    }
    access.execute.insert(access.execute.end(), libraries.begin(), libraries.end());
    access.execute.insert(access.execute.end(), programs.begin(), programs.end());
    access.execute.push_back(program.parent_path());
    return access;
}

}  // namespace mpipov
