// A work folder: journal.json, sections.jsonl, 0.pixels and 2.cache, with lines of %% between them.
#include "entry.h"
#include "failure.h"
#include "journal.h"
#include "json_input.h"
#include "run_record.h"
#include "scratch_files.h"

#include <optional>
#include <string>
#include <system_error>

namespace {

using namespace mpipov;
using fuzz::require;
namespace fs = std::filesystem;
using nlohmann::json;

void use(Journal& journal) {
    try {
        plan_from_json(journal.plan());
    } catch (const std::exception&) {
        // As resume.cpp takes it; plan_from_json is the run record's own.
    }
    // As many as there are.
    const auto any_bytes = [&](int section) -> std::optional<std::uintmax_t> {
        std::error_code error;
        const auto size =
            fs::file_size(journal.folder() / (std::to_string(section) + ".pixels"), error);
        return error ? std::optional<std::uintmax_t>() : size;
    };
    for (const Journal::Finished& one : journal.finished(any_bytes)) {
        require(one.section >= 0, "a section's number is not negative");
        journal.read(one.section);
    }
    const Journal::Cache cache = journal.cache();
    require(cache.waves == 0 ? cache.text.empty() : cache.waves == 2,
            "a cache is one that is there");
    // Goes on as a run does.
    const std::byte pixel{7};
    journal.take(5, {0, 0, 1, 1}, {0, 0, 1, 1}, {&pixel, 1});
    journal.finish(5, {{"rank", 0}});
    bool found = false;
    for (const Journal::Finished& one : journal.finished([](int) { return 1; }))
        if (one.section == 5) found = one.about == json{{"rank", 0}};
    require(found, "what is finished now is found, whatever stood before");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::ScratchFiles scratch;
    const fs::path folder = scratch.folder() / "work" / "journal";
    fs::create_directories(folder);
    const fs::path other = scratch.write("work/not-ours", "kept");
    const auto parts = fuzz::parts_of(fuzz::as_text(data, size), 4);
    constexpr const char* names[] = {"journal.json", "sections.jsonl", "0.pixels", "2.cache"};
    for (std::size_t i = 0; i < parts.size(); ++i)
        scratch.write(std::string("work/journal/") + names[i], parts[i]);
    try {
        // The same as in the stored one where that is to be seen: only then is there more to do.
        json identity;
        try {
            identity = member(parse_json(parts[0]), "identity");
        } catch (const std::runtime_error&) {
            identity = json::object();
        }
        Journal journal = Journal::open(folder, identity);
        use(journal);
        journal.remove();
    } catch (const Failure& failure) {
        require(failure.what()[0] != '\0' &&
                    (failure.code() == Exit::usage || failure.code() == Exit::file),
                "a journal that cannot be used is a failure of its kind");
    }
    require(fs::exists(other), "nothing but the journal's own is removed");
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    return 0;
}
