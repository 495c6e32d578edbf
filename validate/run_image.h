// A run's record, and whether it is the record of an image.
#pragma once

#include "run_record.h"

#include <filesystem>
#include <string>

namespace mpipov {

// Throws Failure(Exit::file), which names the file.
RunRecord read_record(const std::filesystem::path& file);

// The SHA-1 of all pixels as run.json has it: rows from the top, channels interleaved,
// little-endian and as they are stored. Throws Failure(Exit::file).
std::string pixel_sha1(const std::filesystem::path& image);

// Throws Failure(Exit::file) where the record is of neither of the two, which must be images of
// its size. (Of A where B is a copy that was changed since.) Of a JPEG the record has the pixels
// from before they were encoded: nothing can be said there.
void require_record_of(const RunRecord& run, const std::filesystem::path& record,
                       const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace mpipov
