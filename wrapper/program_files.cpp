#include "program_files.h"

#include "child_process.h"
#include "inside.h"
#include "scene_folders.h"

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

// Of an installed POV-Ray: not the whole of its prefix's share, etc and lib, which may be those of
// a home folder.
void add_povrays_own(const fs::path& prefix, std::vector<fs::path>& read) {
    for (const char* own : {"share/povray", "share/povray-3.7", "share/povray-3.8",
                            "share/doc/povray", "share/doc/povray-3.7", "etc/povray"})
        read.push_back(prefix / own);
}

// What the loader would map for it, the libraries of libraries too: a line is
// "libz.so.1 => /lib/libz.so.1 (0x7f...)". It starts nothing of the program.
std::vector<fs::path> libraries_of(const fs::path& program, const fs::path& loader) {
    ChildRequest request;
    request.argv = {loader.string(), "--list", program.string()};
    request.environment = {{"LD_LIBRARY_PATH", library_path_for_scenes()}};
    request.timeout_seconds = 10;
    std::string output;
    run_to_end(request, &output);
    std::vector<fs::path> found;
    for (const std::string_view line : split(output, '\n')) {
        const std::size_t begin = line.find('/'), end = line.rfind(" (0x");
        if (begin != std::string_view::npos && end != std::string_view::npos && begin < end)
            found.emplace_back(line.substr(begin, end - begin));
    }
    return found;
}

bool is_the_systems(const fs::path& program) {
    return lies_in(program, "/usr") || lies_in(program, "/bin");
}

// Beside a script: what it may call, and no notes, settings or keys.
void add_programs_beside(const fs::path& script, std::vector<fs::path>& execute) {
    std::error_code error;
    for (fs::directory_iterator it(script.parent_path(), error);
         !error && it != fs::directory_iterator(); it.increment(error))
        if (can_run(it->path())) execute.push_back(it->path());
}

void add_library_folder(const fs::path& folder, const fs::path& home, std::vector<fs::path>& read) {
    if (!is_for_more_than_a_scene(folder, home) && (home.empty() || !may_be_read(folder, {home}))) {
        read.push_back(folder);
        return;
    }
    std::error_code error;
    for (fs::directory_iterator it(folder, error); !error && it != fs::directory_iterator();
         it.increment(error))
        if (it->path().filename().string().find(".so") != std::string::npos)
            read.push_back(it->path());
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

std::string library_path_for_scenes() {
    std::string kept;
    std::error_code error;
    for (const std::string_view folder : split(variable("LD_LIBRARY_PATH"), ':'))
        if (!folder.empty())
            kept += (kept.empty() ? "" : ":") + fs::absolute(fs::path(folder), error).string();
    return kept;
}

FileAccess files_of_program(const fs::path& program, const fs::path& home) {
    FileAccess access;
    access.write = {"/dev/null"};
    access.read.assign(libraries.begin(), libraries.end());
    access.read.insert(access.read.end(), anybodys.begin(), anybodys.end());
    for (const char* prefix : {"/usr", "/usr/local"}) add_povrays_own(prefix, access.read);
    access.read.emplace_back("/etc/povray");
    if (program.empty()) return access;
    access.execute.push_back(program);
    std::error_code error;
    const fs::path real = fs::weakly_canonical(program, error);
    add_povrays_own(real.parent_path().parent_path(), access.read);
    const std::string more_libraries = library_path_for_scenes();
    if (const auto loader = loader_of(program)) {
        access.execute.push_back(*loader);
        if (loader->empty() || (is_the_systems(real) && more_libraries.empty())) return access;
        for (fs::path& library : libraries_of(real, *loader))
            access.read.push_back(std::move(library));
        return access;
    }
    access.execute.insert(access.execute.end(), libraries.begin(), libraries.end());
    access.execute.insert(access.execute.end(), programs.begin(), programs.end());
    for (const std::string_view folder : split(more_libraries, ':'))
        add_library_folder(folder, home, access.read);
    if (!is_for_more_than_a_scene(program.parent_path(), home))
        add_programs_beside(program, access.execute);
    return access;
}

}  // namespace mpipov
