// What every fuzzer shares. A fuzzer is libFuzzer's entry point, which takes any bytes: it may
// throw nothing, must not take long, and checks what should hold of the result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace mpipov::fuzz {

inline std::string_view as_text(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

// Ends the program as a crash does: both drivers keep the input then.
inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
}

// The parts of an input that stands for several files, separated by a line of "%%"; `most` of them,
// the last takes the rest.
inline std::vector<std::string_view> parts_of(std::string_view text, std::size_t most) {
    constexpr std::string_view separator = "\n%%\n";
    std::vector<std::string_view> parts;
    while (parts.size() + 1 < most) {
        const auto end = text.find(separator);
        if (end == std::string_view::npos) break;
        parts.push_back(text.substr(0, end));
        text.remove_prefix(end + separator.size());
    }
    parts.push_back(text);
    parts.resize(most);
    return parts;
}

}  // namespace mpipov::fuzz
