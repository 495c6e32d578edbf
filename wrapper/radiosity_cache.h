// A radiosity cache of POV-Ray: the file that +RFO writes and +RFI reads is text, one sample a
// line ("C2<tab>x<tab>y<tab>z<tab>..."), so caches are joined by putting their lines together
// (docs/radiosity.md, with the experiment). Pure.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace mpipov {

// The lines of such a file. Throws std::runtime_error where one is no sample, or is cut short.
std::vector<std::string_view> samples_of(std::string_view text);

class RadiosityCache {
  public:
    // Adds the samples of a file behind those that are there, each once. Throws std::runtime_error
    // where a line is no sample: then none of them is added.
    void add(std::string_view text);

    // As POV-Ray reads it.
    const std::string& text() const { return text_; }
    bool empty() const { return text_.empty(); }
    long long samples() const { return static_cast<long long>(known_.size()); }

  private:
    std::string text_;
    std::unordered_set<std::string> known_;
};

}  // namespace mpipov
