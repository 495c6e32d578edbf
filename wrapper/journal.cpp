#include "journal.h"

#include "failure.h"

#include <OpenImageIO/hash.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace mpipov {
namespace {

using nlohmann::json;

[[noreturn]] void cannot_write(const std::filesystem::path& file) {
    throw Failure(Exit::file,
                  fmt::format("cannot write '{}': {}", file.string(), std::strerror(errno)));
}

}  // namespace

std::string sha1_of_file(const std::filesystem::path& file) {
    OIIO::SHA1 sha;
    std::ifstream in(file, std::ios::binary);
    if (!in) return {};
    std::vector<char> buffer(std::size_t{1} << 20);
    while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0)
        sha.append(buffer.data(), static_cast<std::size_t>(in.gcount()));
    return sha.digest();
}

std::filesystem::path Journal::pixel_file(int section) const {
    return folder_ / fmt::format("{}.pixels", section);
}

Journal Journal::create(const std::filesystem::path& folder, const json& identity,
                        const json& plan) {
    std::error_code error;
    std::filesystem::remove_all(folder, error);
    std::filesystem::create_directories(folder, error);
    if (error)
        throw Failure(Exit::file, fmt::format("cannot make the work folder '{}': {}",
                                              folder.string(), error.message()));
    Journal journal(folder);
    journal.plan_ = plan;
    const std::filesystem::path file = folder / "journal.json";
    std::ofstream out(file);
    out << json{{"format", "mpipov-journal"},
                {"version", 1},
                {"identity", identity},
                {"plan", plan}}
               .dump(2, ' ', false, json::error_handler_t::replace)
        << '\n';
    if (!out.flush()) cannot_write(file);
    return journal;
}

Journal Journal::open(const std::filesystem::path& folder, const json& identity) {
    const std::filesystem::path file = folder / "journal.json";
    std::ifstream in(file);
    if (!in)
        throw Failure(Exit::usage, fmt::format("--resume: nothing to go on from in '{}'; run "
                                               "without --resume",
                                               folder.string()));
    const json stored = json::parse(in, nullptr, false);
    if (stored.is_discarded() || stored.value("format", "") != "mpipov-journal")
        throw Failure(Exit::file,
                      fmt::format("'{}' is damaged; run without --resume", file.string()));
    for (const auto& [key, value] : identity.items())
        if (!stored.at("identity").contains(key) || stored.at("identity").at(key) != value)
            throw Failure(Exit::usage,
                          fmt::format("--resume: the {} changed since the run that '{}' belongs "
                                      "to; run without --resume",
                                      key, folder.string()));
    Journal journal(folder);
    journal.plan_ = stored.at("plan");
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
    if (!out) cannot_write(pixel_file(section));
}

void Journal::finish(int section, const json& about) {
    auto found = open_.find(section);
    if (found != open_.end()) {
        found->second.close();
        if (!found->second) cannot_write(pixel_file(section));
        open_.erase(found);
    }
    const std::filesystem::path file = folder_ / "sections.jsonl";
    std::ofstream out(file, std::ios::app);
    out << json{{"section", section}, {"sha1", sha1_of_file(pixel_file(section))}, {"about", about}}
               .dump(-1, ' ', false, json::error_handler_t::replace)
        << '\n';
    if (!out.flush()) cannot_write(file);
}

std::vector<Journal::Finished> Journal::finished() const {
    std::map<int, json> last;  // of a section that was finished twice, the last line counts
    std::ifstream in(folder_ / "sections.jsonl");
    for (std::string line; std::getline(in, line);) {
        json entry = json::parse(line, nullptr, false);
        if (entry.is_discarded() || !entry.contains("section")) continue;  // cut off by the end
        last[entry.at("section").get<int>()] = std::move(entry);
    }
    std::vector<Finished> finished;
    for (const auto& [section, entry] : last)
        if (sha1_of_file(pixel_file(section)) == entry.at("sha1").get<std::string>())
            finished.push_back({section, entry.at("about")});
    return finished;
}

std::vector<std::byte> Journal::read(int section) const {
    std::ifstream in(pixel_file(section), std::ios::binary);
    std::vector<std::byte> pixels(std::filesystem::file_size(pixel_file(section)));
    in.read(reinterpret_cast<char*>(pixels.data()), static_cast<std::streamsize>(pixels.size()));
    if (!in) cannot_write(pixel_file(section));
    return pixels;
}

void Journal::remove() {
    open_.clear();
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

}  // namespace mpipov
