#include "mutate.h"

#include <algorithm>
#include <array>

namespace mpipov::fuzz {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 16;

// At the edges of what numbers hold.
constexpr std::array numbers{"0",
                             "-1",
                             "1",
                             "127",
                             "32768",
                             "2147483647",
                             "2147483648",
                             "-2147483648",
                             "4294967295",
                             "4294967297",
                             "9223372036854775807",
                             "9223372036854775808",
                             "18446744073709551616",
                             "1e308",
                             "1e999",
                             "-0.0",
                             "1.5",
                             "1e-320",
                             "nan",
                             "null",
                             "true",
                             "\"\"",
                             "[]",
                             "{}"};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

}  // namespace

std::size_t Mutator::below(std::size_t end) {
    return end == 0 ? 0 : static_cast<std::size_t>(random_() % end);
}

std::string Mutator::number() {
    return numbers[below(numbers.size())];
}

void Mutator::change(std::string& text, const std::vector<std::string>& corpus) {
    const std::size_t at = below(text.size() + 1);
    const std::size_t length = below(std::min<std::size_t>(text.size() - at, 64) + 1);
    switch (below(10)) {
        case 0:  // one bit
            if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
            break;
        case 1:
            if (at < text.size()) text[at] = static_cast<char>(below(256));
            break;
        case 2:
            text.erase(at, length);
            break;
        case 3:
            text.insert(below(text.size() + 1), text.substr(at, length));
            break;
        case 4:
            if (!words_.empty()) text.insert(at, words_[below(words_.size())]);
            break;
        case 5:
            if (!words_.empty()) text.replace(at, length, words_[below(words_.size())]);
            break;
        case 6: {  // a number becomes another one
            const auto begin =
                std::find_if(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(), is_digit);
            const auto end = std::find_if_not(begin, text.end(), is_digit);
            text.replace(begin, end, number());
            break;
        }
        case 7: {  // the end of another one
            const std::string& other = corpus[below(corpus.size())];
            text = text.substr(0, at) + other.substr(below(other.size() + 1));
            break;
        }
        case 8:  // cut short
            text.resize(at);
            break;
        default: {  // a piece many times
            const std::string piece = text.substr(at, length);
            for (std::size_t i = below(200); i > 0 && text.size() < most_bytes; --i)
                text.insert(at, piece);
        }
    }
    if (text.size() > most_bytes) text.resize(most_bytes);
}

std::string Mutator::next(const std::vector<std::string>& corpus) {
    std::string text = corpus[below(corpus.size())];
    for (std::size_t changes = 1 + below(8); changes > 0; --changes) change(text, corpus);
    return text;
}

std::string stretched(const std::string& word, std::size_t bytes) {
    std::string text;
    text.reserve(bytes + word.size());
    while (!word.empty() && text.size() < bytes) text += word;
    return text;
}

}  // namespace mpipov::fuzz
