#include "confinement.h"

#include "failure.h"
#include "povray_command.h"
#include "program_files.h"
#include "refused_file.h"
#include "scene_files.h"
#include "scene_folders.h"
#include "user_settings.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

// POV-Ray's own restriction of files does nothing in Debian's build (docs/povray.md); that of
// commands does.
constexpr const char* configuration = R"([File I/O Security]
restricted

[Shellout Security]
forbidden

[Permitted Paths]
read = %INSTALLDIR%/include
read+write = .
)";
constexpr const char* version_folder = ".povray/3.7";

// What remains of a machine for everything else.
constexpr double memory_share = 0.8;
// Below it POV-Ray could hardly render anything; Linux ends it first where that is too much.
constexpr std::uint64_t least_memory_bytes = std::uint64_t{1} << 30;
constexpr std::uint64_t least_disk_bytes = std::uint64_t{1} << 30;
// Of a frame: 20 in a temporary file, as many as 16 in an image, and the same for both where they
// are written a second time.
constexpr std::uint64_t disk_bytes_per_pixel = 72;

fs::path write_configuration(const fs::path& own) {
    fs::path home = own / "home";
    std::error_code error;
    fs::create_directories(home / version_folder, error);
    const fs::path file = home / version_folder / "povray.conf";
    std::ofstream out(file);
    out << configuration;
    if (!out.flush())
        throw Failure(Exit::file,
                      fmt::format("cannot write '{}': {}", file.string(), std::strerror(errno)));
    return home;
}

std::uint64_t number_in(const char* file) {
    std::ifstream in(file);
    std::string word;
    in >> word;
    std::uint64_t number = 0;
    const auto end = std::from_chars(word.data(), word.data() + word.size(), number);
    return end.ec == std::errc() && end.ptr == word.data() + word.size() ? number : 0;
}

void require_present(const char* option, const std::vector<fs::path>& paths) {
    std::error_code error;
    for (const fs::path& path : paths)
        if (!fs::exists(path, error))
            throw Failure(Exit::usage,
                          fmt::format("{} '{}': no such file or folder", option, path.string()));
}

}  // namespace

HostResources resources_of_host(int cores) {
    const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
    HostResources host{static_cast<std::uint64_t>(std::max(0L, pages)) *
                           static_cast<std::uint64_t>(std::max(0L, page)),
                       std::max(1, cores)};
    // A container's or a job's; the number of no limit is larger than any memory.
    for (const char* file :
         {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
        if (const std::uint64_t most = number_in(file); most > 0)
            host.memory_bytes = std::min(host.memory_bytes, most);
    return host;
}

Confinement::Confinement(const Options& options, const HostResources& host, const fs::path& own)
    : on_(true), memory_(options.memory_limit), disk_(options.disk_limit), host_(host) {
    const FolderRequest user = request_of_user(options.povray_arguments);
    const fs::path &home = user.home, &settings = user.settings, &run_folder = user.run_folder;
    home_ = home;
    FileAccess scene;
    scene.read = scene_folders(user);
    resolve_links(scene);
    users_ = scene.read;
    std::error_code error;
    for (const fs::path& path : options.allow_read)
        users_.push_back(fs::weakly_canonical(path, error));
    environment_ = {{"HOME", write_configuration(own).string()}};
    if (!settings.empty()) environment_.emplace_back("POVINI", settings.string());
    if (std::getenv("LD_LIBRARY_PATH") != nullptr)
        environment_.emplace_back("LD_LIBRARY_PATH", library_path_for_scenes());
    program_name_ = options.povray;
    program_file_ = find_program(options.povray);
    off_ = options.confine == Confining::off;
    if (off_) return;
    if (!can_restrict_files()) {
        if (options.confine == Confining::automatic) return;
        throw Failure(Exit::usage,
                      "--confine on: this kernel cannot keep a program from files (Landlock, from "
                      "Linux 5.13 on)");
    }
    require_present("--allow-read", options.allow_read);
    require_present("--allow-write", options.allow_write);
    program_ = files_of_program(program_file_, home);
    for (const fs::path& path : options.allow_read)
        program_.read.push_back(fs::absolute(path, error));
    for (const fs::path& path : options.allow_write)
        program_.write.push_back(fs::absolute(path, error));
    program_.read.push_back(own / "home");
    resolve_links(program_);
    files_ = program_;
    files_->read.insert(files_->read.end(), scene.read.begin(), scene.read.end());
    search(run_folder, options.povray_arguments);
    writes_ = writes_of_scene(options.povray_arguments, {searched_.begin() + 1, searched_.end()});
    // Where it may write there anyway it does so as POV-Ray alone.
    if (may_be_read(run_folder, files_->write)) writes_.any = false;
}

void Confinement::search(const fs::path& run_folder, const std::vector<std::string>& arguments) {
    searched_ = {run_folder};
    for (const std::string& argument : arguments)
        for (const std::string& folder : library_paths_in(argument))
            searched_.push_back(run_folder / folder);
    // Those of its INI files too: so a name that is not found there is told with the way out.
    for (const std::string& argument : arguments)
        for (const std::string& name : names_in_option(argument))
            if (is_ini(name))
                for (const std::string& folder : library_paths_of(run_folder / name))
                    searched_.push_back(run_folder / folder);
}

Confinement Confinement::in_copy(const SceneCopy& copy) const {
    Confinement confinement = *this;
    confinement.run_folder_ = copy.run_folder;
    std::erase_if(confinement.environment_, [](const auto& one) { return one.first == "POVINI"; });
    confinement.environment_.emplace_back("POVINI", copy.settings.string());
    if (!files_) return confinement;
    confinement.files_ = program_;
    confinement.files_->read.push_back(copy.root);
    confinement.search(copy.run_folder, copy.arguments);
    confinement.writes_ = writes_in_folder(copy.root);
    return confinement;
}

std::string Confinement::note() const {
    if (writes_.any)
        return "the scene writes files, which are removed with its launches: --allow-write . keeps "
               "them";
    if (on_ && !files_ && !off_)
        return "this kernel cannot keep a scene from your files (Landlock); --confine on refuses "
               "to render then";
    return {};
}

std::uint64_t Confinement::memory_limit(int threads) const {
    if (!memory_.automatic) return memory_.bytes.value_or(0);
    const double all = memory_share * static_cast<double>(host_.memory_bytes);
    const double part = all * std::min(threads, host_.cores) / host_.cores;
    return std::max(least_memory_bytes, static_cast<std::uint64_t>(part));
}

std::optional<std::uint64_t> Confinement::file_limit(const LaunchNeeds& needs) const {
    if (!disk_.automatic) return disk_.bytes;
    if (!needs.pixels) return {};
    return least_disk_bytes + disk_bytes_per_pixel * *needs.pixels;
}

std::optional<std::uint64_t> Confinement::folder_limit(const LaunchNeeds& needs) const {
    if (!disk_.automatic) return disk_.bytes;
    std::error_code error;
    const fs::space_info space = fs::space(needs.folder, error);
    const std::uint64_t half = error ? least_disk_bytes : space.available / 2;
    return std::min(half, file_limit(needs).value_or(half));
}

ChildRequest Confinement::request(LaunchNeeds needs) const {
    ChildRequest request;
    request.argv = std::move(needs.argv);
    request.environment = temporary_files_in(needs.folder);
    request.timeout_seconds = needs.timeout_seconds;
    if (!on_) return request;
    // Not one of that name in the folder that it runs in, where PATH has an empty part.
    if (!program_file_.empty() && request.argv.front() == program_name_)
        request.argv.front() = program_file_.string();
    request.environment.insert(request.environment.end(), environment_.begin(), environment_.end());
    if (const std::uint64_t bytes = memory_limit(needs.threads)) request.memory_limit_bytes = bytes;
    request.file_size_limit_bytes = file_limit(needs);
    if (const auto bytes = folder_limit(needs)) request.folder_limit = {needs.folder, *bytes};
    request.working_directory = run_folder_;
    if (!files_) return request;
    request.files = files_;
    request.files->write.push_back(needs.folder);
    if (writes_.any)
        request.working_directory =
            make_writable_view(needs.folder / "view", searched_.front(), writes_, files_->read);
    request.files->read.insert(request.files->read.end(), needs.reads.begin(), needs.reads.end());
    request.files->execute.insert(request.files->execute.end(), needs.executes.begin(),
                                  needs.executes.end());
    return request;
}

bool Confinement::is_users(const fs::path& file) const {
    return may_be_read(file, users_);
}

bool Confinement::may_read(const fs::path& path) const {
    return !files_ || may_be_read(path, files_->read) || may_be_read(path, files_->write);
}

std::string Confinement::way_out(std::string_view error) const {
    if (!on_) return {};
    if (files_ && error.find("error while loading shared libraries") != std::string_view::npos)
        return " (allow the folder of POV-Ray's libraries with --allow-read)";
    if (error.find("bad_alloc") != std::string_view::npos)
        return " (out of memory: allow a launch more with --memory-limit)";
    if (!files_) return {};
    const auto refused = refused_file(error);
    if (!refused) return {};
    return refused->to_write ? way_to_write(refused->name) : way_to_read(refused->name);
}

std::string Confinement::way_to_read(const std::string& name) const {
    std::error_code ignored;
    for (const fs::path& folder : searched_)
        for (const fs::path& file : files_tried_for(folder / name)) {
            if (!fs::exists(file, ignored) || may_read(file)) continue;
            const fs::path real = fs::weakly_canonical(file, ignored);
            const std::string refused =
                fmt::format(" ('{}' may not be read by a scene: ", file.string());
            if (is_a_scenes_file(real) && may_be_proposed(real.parent_path(), home_))
                return refused + fmt::format("allow its folder with --allow-read '{}')",
                                             real.parent_path().string());
            return refused + "if you trust the scene with it, see --allow-read)";
        }
    return {};
}

std::string Confinement::way_to_write(const std::string& name) const {
    std::error_code ignored;
    const fs::path file = (searched_.front() / name).lexically_normal();
    const fs::path real = fs::weakly_canonical(file, ignored).parent_path();
    if (may_be_read(real, files_->write)) return {};
    const std::string refused =
        fmt::format(" ('{}' may not be written by a scene: ", file.string());
    if (fs::is_directory(real, ignored) && may_be_proposed(real, home_))
        return refused + fmt::format("allow its folder with --allow-write '{}')", real.string());
    return refused + "if you trust the scene with it, see --allow-write)";
}

}  // namespace mpipov
