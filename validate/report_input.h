// What the report is made of: the results below a folder, read and checked.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>

namespace mpipov {

// {"format": "mpipov-report", "version": 1, "root": "/...", "entries": [{"kind": "seams" |
// "speedup" | "noise" | "tradeoff" | "stability", "file": relative to the root, "folder": "/...",
// "problems": [text], "data":
// {...} | null}]}: every file of such a name (seams.json, ...) at any depth, in the order of
// their paths. Links to folders are not followed. A file that cannot be used has no data; one that
// lacks parts has problems, and its data as they are. Throws Failure(Exit::file) where the folder
// cannot be searched.
nlohmann::json collect_results(const std::filesystem::path& root);

}  // namespace mpipov
