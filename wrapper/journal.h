// Finished sections on disk, so that a run that was interrupted can go on.
//
// A journal is a folder: journal.json says what is rendered and how it is cut up, sections.jsonl
// has one line for each finished section with the SHA-1 of its pixels, N.pixels has those pixels. A
// section counts only with its line, which is written last. N.cache is the radiosity cache after N
// waves of gathering (radiosity_sharing.h), and its SHA-1 in a last line.
#pragma once

#include "fd.h"
#include "image_file.h"
#include "section.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mpipov {

class Journal {
  public:
    // Starts a new journal in `folder`, in place of an old one. Throws Failure(Exit::file), also
    // where the folder holds anything that is not a journal's; no folder is left behind then.
    // Failure(Exit::usage) where another run has it, as open().
    static Journal create(const std::filesystem::path& folder, const nlohmann::json& identity,
                          const nlohmann::json& plan);
    // Opens the one that an earlier run left. Throws Failure(Exit::usage) where there is none or
    // where `identity` differs (what_changed() in job_identity.h); Failure(Exit::file) where it is
    // damaged.
    static Journal open(const std::filesystem::path& folder, const nlohmann::json& identity);

    const nlohmann::json& plan() const { return plan_; }

    // The rows of a section as they come in; a first row begins the section anew.
    void take(int section, const Rect& render, const Rect& rect, std::span<const std::byte> pixels);
    // The section is complete; `about` comes back from finished().
    void finish(int section, const nlohmann::json& about);

    struct Finished {
        int section = 0;
        nlohmann::json about;
    };
    // What earlier runs finished and whose pixels are still as they were. `bytes_of` says how many
    // bytes the pixels of a section take, or that there is none of this number: files of other
    // sizes are not even read.
    using SectionBytes = std::function<std::optional<std::uintmax_t>(int section)>;
    std::vector<Finished> finished(const SectionBytes& bytes_of) const;
    // The pixels of such a section, all rows of `render`. Throws Failure(Exit::file).
    std::vector<std::byte> read(int section) const;

    // The cache that `waves` waves have made; it stands for all earlier ones. Throws
    // Failure(Exit::file).
    void keep_cache(int waves, const std::string& cache);
    struct Cache {
        int waves = 0;
        std::string text;
    };
    // The last one that was kept and is still as it was; {0, ""} where there is none.
    Cache cache() const;

    // Removes the journal, and the folders that create() made for it (this run's or the one's that
    // it goes on from) where nothing else is in them: the result is complete.
    void remove();

    const std::filesystem::path& folder() const { return folder_; }

  private:
    explicit Journal(std::filesystem::path folder) : folder_(std::move(folder)) {}
    void begin(const nlohmann::json& identity);
    std::filesystem::path pixel_file(int section) const;
    std::filesystem::path cache_file(int waves) const;
    std::vector<int> waves_kept() const;  // the last first

    std::filesystem::path folder_;
    Fd lock_;  // on journal.json, for as long as this run has it
    nlohmann::json plan_;
    int folders_made_ = 0;  // the folder itself, then the one that it is in, and so on
    std::map<int, std::ofstream> open_;
};

// 40 hexadecimal digits, as sha1sum prints them; empty where the file cannot be read.
std::string sha1_of_file(const std::filesystem::path& file);

}  // namespace mpipov
