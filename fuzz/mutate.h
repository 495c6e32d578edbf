// New inputs out of known ones: what a fuzzer does that cannot see which code an input reached.
// The same for the same seed.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace mpipov::fuzz {

class Mutator {
  public:
    // `words`: what the format is made of.
    Mutator(std::vector<std::string> words, unsigned seed)
        : words_(std::move(words)), random_(seed) {}

    // One to eight changes of one of `corpus`, which must not be empty.
    std::string next(const std::vector<std::string>& corpus);

  private:
    std::size_t below(std::size_t end);  // 0 where end is
    void change(std::string& text, const std::vector<std::string>& corpus);
    std::string number();

    std::vector<std::string> words_;
    std::mt19937_64 random_;
};

// `word` again and again: what takes more than linear time shows.
std::string stretched(const std::string& word, std::size_t bytes);

}  // namespace mpipov::fuzz
