// Radiosity caches of POV-Ray: two files, with a line of %% between them.
#include "cache_stream.h"
#include "entry.h"
#include "radiosity_cache.h"

#include <cstring>
#include <stdexcept>
#include <string>

namespace {

using namespace mpipov;
using fuzz::require;

void check_pieces(const std::string& text) {
    std::string joined;
    std::size_t offset = 0;
    while (const auto piece = next_piece(text, offset))
        joined.append(reinterpret_cast<const char*>(piece->data()), piece->size());
    require(joined == text, "pieces are the whole");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    RadiosityCache cache;
    for (const std::string_view file : fuzz::parts_of(fuzz::as_text(data, size), 2)) {
        const std::string before = cache.text();
        try {
            const auto lines = samples_of(file);
            cache.add(file);
            require(cache.samples() <= cache.samples() + static_cast<long long>(lines.size()),
                    "no more samples than lines");
            require(cache.text().starts_with(before), "what was there stays in front");
            require(cache.text().size() <= before.size() + file.size(), "nothing else is added");
            require(samples_of(cache.text()).size() == static_cast<std::size_t>(cache.samples()),
                    "each sample is there once");
            const std::string once = cache.text();
            cache.add(file);
            require(cache.text() == once, "what is known is not added again");
        } catch (const std::runtime_error&) {
            require(cache.text() == before, "of a damaged file nothing is added");
        }
    }
    check_pieces(cache.text());
    return 0;
}
