#include "journal.h"

#include "failure.h"
#include "job_identity.h"
#include "json_input.h"
#include "sha1_digits.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <functional>
#include <optional>
#include <utility>

namespace mpipov {
namespace {

using nlohmann::json;

constexpr std::string_view journal_name = "journal.json";
constexpr std::string_view sections_name = "sections.jsonl";
constexpr std::string_view pixels_extension = ".pixels";
constexpr std::string_view cache_extension = ".cache";
constexpr const char* folders_key = "folders made";
constexpr int format_version = 2;

[[noreturn]] void cannot(const char* what, const std::filesystem::path& file) {
    throw Failure(Exit::file,
                  fmt::format("cannot {} '{}': {}", what, file.string(), std::strerror(errno)));
}

// Texts that are no UTF-8 (file names may be anything) as they come back from the file.
std::string to_text(const json& value, int indent = -1) {
    return value.dump(indent, ' ', false, json::error_handler_t::replace);
}

bool belongs_to_a_journal(const std::filesystem::path& file) {
    const std::string name = file.filename().string();
    if (name == journal_name || name == sections_name) return true;
    return std::ranges::any_of(
        std::array{pixels_extension, cache_extension}, [&](std::string_view extension) {
            return file.extension() == extension &&
                   name.find_first_not_of("0123456789") == name.size() - extension.size();
        });
}

// Nothing else is ever removed: --work-dir may name any folder.
void remove_files(const std::filesystem::path& folder, std::string_view but = {}) {
    std::error_code ignored;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (belongs_to_a_journal(entry.path()) && entry.path().filename() != but)
            files.push_back(entry.path());
    for (const std::filesystem::path& file : files) std::filesystem::remove(file, ignored);
}

// So that no other run empties the folder, or adds to it, while this one has it; the kernel lets go
// of it when the process ends, however it ends. Where there can be no lock, writing will say why.
Fd lock_for_one_run(const std::filesystem::path& file, int flags) {
    constexpr mode_t as_streams_do = 0666;
    Fd fd;
    // For reading: a file that is open for writing keeps its disk from being made read-only. But
    // NFS wants it open for writing (EBADF).
    for (const int how : {O_RDONLY, O_RDWR}) {
        fd = Fd(::open(file.c_str(), how | O_CLOEXEC | O_NOFOLLOW | flags, as_streams_do));
        if (fd.get() < 0 || ::flock(fd.get(), LOCK_EX | LOCK_NB) == 0) break;
        if (errno == EWOULDBLOCK)
            throw Failure(Exit::usage,
                          fmt::format("the work folder '{}' is in use by another run: wait for "
                                      "its end, or name another one with --work-dir",
                                      file.parent_path().string()));
        if (errno != EBADF) break;
    }
    return fd;
}

// What an interruption cut off stays a line of its own, which does not count.
void end_last_line(const std::filesystem::path& file) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    if (!stream.seekg(-1, std::ios::end) || stream.get() == '\n') return;
    stream.seekp(0, std::ios::end);
    if (!stream.put('\n').flush()) cannot("write", file);
}

// Null where there is none, or it is no journal of ours.
json read_head(const std::filesystem::path& folder) {
    std::ifstream in(folder / journal_name);
    try {
        json head = parse_json(in);
        member<int>(head, folders_key, 0);
        member(head, "identity");
        member(head, "plan");
        if (member(head, "format") == "mpipov-journal" && member(head, "version") == format_version)
            return head;
    } catch (const std::runtime_error&) {
        // Damaged, as far as a journal goes.
    }
    return {};
}

// "a/b/" names the same folder as "a/b", but its parent is another.
std::filesystem::path without_last_slash(const std::filesystem::path& folder) {
    return folder.has_filename() || !folder.has_parent_path() ? folder : folder.parent_path();
}

// How many folders of this path there are not, beginning at its end.
int missing_folders(std::filesystem::path folder) {
    int missing = 0;
    std::error_code ignored;
    for (; !folder.empty() && !std::filesystem::exists(folder, ignored);
         folder = folder.parent_path())
        ++missing;
    return missing;
}

// Not past the root, however many a damaged journal asks for.
void remove_empty_folders(std::filesystem::path folder, int how_many) {
    for (; how_many > 0 && folder.has_relative_path(); --how_many, folder = folder.parent_path())
        ::rmdir(folder.c_str());
}

constexpr std::size_t sha1_line = 41;

struct Entry {
    int section = 0;
    std::string sha1;
    json about;
};

// Nothing where the line was cut off by the end, or is damaged.
std::optional<Entry> read_entry(const std::string& line) {
    try {
        const json entry = parse_json(std::string_view(line));
        return Entry{member<int>(entry, "section", 0), member<std::string>(entry, "sha1"),
                     member(entry, "about")};
    } catch (const std::runtime_error&) {
        return {};
    }
}

}  // namespace

std::string sha1_of_file(const std::filesystem::path& file) {
    OIIO::SHA1 sha;
    std::ifstream in(file, std::ios::binary);
    if (!in) return {};
    std::vector<char> buffer(std::size_t{1} << 20);
    while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0)
        sha.append(buffer.data(), static_cast<std::size_t>(in.gcount()));
    return sha1_digits(sha);
}

std::filesystem::path Journal::pixel_file(int section) const {
    return folder_ / fmt::format("{}{}", section, pixels_extension);
}

Journal Journal::create(const std::filesystem::path& folder, const json& identity,
                        const json& plan) {
    const json earlier = read_head(folder);
    Journal journal(without_last_slash(folder));
    journal.plan_ = plan;
    // What an interrupted run made in vain is this one's to remove.
    journal.folders_made_ =
        earlier.is_null() ? missing_folders(journal.folder_) : member<int>(earlier, folders_key);
    try {
        journal.begin(identity);
    } catch (...) {
        remove_empty_folders(journal.folder_, journal.folders_made_);
        throw;
    }
    return journal;
}

void Journal::begin(const json& identity) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error)
        throw Failure(Exit::file, fmt::format("cannot make the work folder '{}': {}",
                                              folder_.string(), error.message()));
    for (const auto& entry : std::filesystem::directory_iterator(folder_, error))
        if (!belongs_to_a_journal(entry.path()))
            throw Failure(Exit::file,
                          fmt::format("the work folder '{}' holds '{}', which is not mpipov's: "
                                      "name another one with --work-dir",
                                      folder_.string(), entry.path().filename().string()));
    const std::filesystem::path file = folder_ / journal_name;
    lock_ = lock_for_one_run(file, O_CREAT);
    remove_files(folder_, journal_name);
    std::ofstream out(file);
    out << to_text({{"format", "mpipov-journal"},
                    {"version", format_version},
                    {folders_key, folders_made_},
                    {"identity", identity},
                    {"plan", plan_}},
                   2)
        << '\n';
    if (out.flush()) return;
    const int why = errno;
    out.close();
    remove_files(folder_);
    errno = why;
    cannot("write", file);
}

Journal Journal::open(const std::filesystem::path& folder, const json& identity) {
    const std::filesystem::path file = folder / journal_name;
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        throw Failure(Exit::usage, fmt::format("--resume: nothing to go on from in '{}'; run "
                                               "without --resume",
                                               folder.string()));
    Fd lock = lock_for_one_run(file, 0);
    const json stored = read_head(folder);
    if (stored.is_null())
        throw Failure(Exit::file,
                      fmt::format("'{}' is damaged; run without --resume", file.string()));
    const std::string change = what_changed(stored.at("identity"), json::parse(to_text(identity)));
    if (!change.empty())
        throw Failure(Exit::usage,
                      fmt::format("--resume: {} since the run that '{}' belongs to; run without "
                                  "--resume",
                                  change, folder.string()));
    Journal journal(without_last_slash(folder));
    journal.lock_ = std::move(lock);
    journal.plan_ = stored.at("plan");
    journal.folders_made_ = member<int>(stored, folders_key);
    end_last_line(folder / sections_name);
    return journal;
}

void Journal::take(int section, const Rect& render, const Rect& rect,
                   std::span<const std::byte> pixels) {
    if (rect.y0 == render.y0) {
        open_.erase(section);
        open_.emplace(section, std::ofstream(pixel_file(section), std::ios::binary));
    }
    std::ofstream& out = open_.at(section);
    out.write(reinterpret_cast<const char*>(pixels.data()),
              static_cast<std::streamsize>(pixels.size()));
    if (!out) cannot("write", pixel_file(section));
}

void Journal::finish(int section, const json& about) {
    auto found = open_.find(section);
    if (found != open_.end()) {
        found->second.close();
        if (!found->second) cannot("write", pixel_file(section));
        open_.erase(found);
    }
    const std::string sha1 = sha1_of_file(pixel_file(section));
    if (sha1.empty()) cannot("read", pixel_file(section));
    const std::filesystem::path file = folder_ / sections_name;
    std::ofstream out(file, std::ios::app);
    out << to_text({{"section", section}, {"sha1", sha1}, {"about", about}}) << '\n';
    if (!out.flush()) cannot("write", file);
}

std::vector<Journal::Finished> Journal::finished(const SectionBytes& bytes_of) const {
    std::map<int, Entry> last;  // of a section that was finished twice, the last line counts
    std::ifstream in(folder_ / sections_name);
    for (std::string line; std::getline(in, line);) {
        if (auto entry = read_entry(line)) last.insert_or_assign(entry->section, std::move(*entry));
    }
    std::vector<Finished> finished;
    for (auto& [section, entry] : last) {
        std::error_code error;
        const auto size = std::filesystem::file_size(pixel_file(section), error);
        if (error || bytes_of(section) != size) continue;
        if (sha1_of_file(pixel_file(section)) == entry.sha1)
            finished.push_back({section, std::move(entry.about)});
    }
    return finished;
}

std::vector<std::byte> Journal::read(int section) const {
    std::ifstream in(pixel_file(section), std::ios::binary);
    std::error_code error;
    const auto size = std::filesystem::file_size(pixel_file(section), error);
    if (!in || error) cannot("read", pixel_file(section));
    std::vector<std::byte> pixels(size);
    if (!in.read(reinterpret_cast<char*>(pixels.data()), static_cast<std::streamsize>(size)))
        cannot("read", pixel_file(section));
    return pixels;
}

std::filesystem::path Journal::cache_file(int waves) const {
    return folder_ / fmt::format("{}{}", waves, cache_extension);
}

void Journal::keep_cache(int waves, const std::string& cache) {
    const std::filesystem::path file = cache_file(waves);
    std::ofstream out(file, std::ios::binary);
    out << cache << sha1_of_text(cache) << '\n';
    if (!out.flush()) cannot("write", file);
    std::error_code ignored;
    for (int earlier = 0; earlier < waves; ++earlier)
        std::filesystem::remove(cache_file(earlier), ignored);
}

std::vector<int> Journal::waves_kept() const {
    std::vector<int> kept;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored)) {
        const std::string digits = entry.path().stem();
        int waves = 0;
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), waves);
        if (entry.path().extension() == cache_extension && error == std::errc() &&
            end == digits.data() + digits.size() && waves > 0)
            kept.push_back(waves);
    }
    std::ranges::sort(kept, std::greater());
    return kept;
}

Journal::Cache Journal::cache() const {
    for (const int waves : waves_kept()) {
        std::ifstream in(cache_file(waves), std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(in), {}};
        if (text.size() < sha1_line) continue;
        const std::string sha1 = text.substr(text.size() - sha1_line);
        text.resize(text.size() - sha1_line);
        if (sha1 == sha1_of_text(text) + '\n') return {waves, std::move(text)};
    }
    return {};
}

void Journal::remove() {
    open_.clear();
    remove_files(folder_);
    remove_empty_folders(folder_, folders_made_);
}

}  // namespace mpipov
