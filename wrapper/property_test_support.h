// Property tests: many rounds of random input, always the same, and what a failure was made of.
//
// A failed round prints its seed. MPIPOV_PROPERTY_SEED=N runs that one alone,
// MPIPOV_PROPERTY_ROUNDS=N makes N times as many rounds of every property.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace mpipov {

class Random {
  public:
    explicit Random(std::uint64_t seed) : random_(seed) {}
    // Both ends included.
    int between(int low, int high) {
        const auto count = static_cast<std::uint64_t>(static_cast<std::int64_t>(high) - low) + 1;
        return static_cast<int>(low + static_cast<std::int64_t>(random_() % count));
    }
    bool one_in(int n) { return between(1, n) == 1; }
    template <typename Value>
    const Value& one_of(const std::vector<Value>& values) {
        return values[random_() % values.size()];
    }
    std::mt19937_64& engine() { return random_; }

  private:
    std::mt19937_64 random_;
};

// Calls body(Random&) so often; the first round that fails is the last.
template <typename Body>
void for_rounds(int rounds, const Body& body) {
    constexpr std::uint64_t first_seed = 1999;
    const auto setting = [](const char* name) {
        const char* text = std::getenv(name);
        return text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
    };
    std::uint64_t first = first_seed, count = static_cast<std::uint64_t>(rounds);
    if (const auto times = setting("MPIPOV_PROPERTY_ROUNDS"); times > 0) count *= times;
    if (const auto seed = setting("MPIPOV_PROPERTY_SEED"); seed > 0) {
        first = seed;
        count = 1;
    }
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        SCOPED_TRACE("MPIPOV_PROPERTY_SEED=" + std::to_string(seed));
        Random random(seed);
        body(random);
        if (testing::Test::HasFailure()) return;
    }
}

}  // namespace mpipov
