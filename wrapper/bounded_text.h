// What a child process printed, of which only so much is kept.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace mpipov {

// Keeps the first and the last half of what is appended, once that is more than the limit.
class BoundedText {
  public:
    explicit BoundedText(std::size_t limit)
        : limit_(limit),
          marker_(
              fmt::format("\n[mpipov: more than {} bytes of output, middle left out]\n", limit)) {}

    void append(std::string_view more) {
        text_ += more;
        if (!cut_ && text_.size() > limit_) {
            text_.insert(limit_ / 2, marker_);
            cut_ = true;
        }
        // Moving the tail only now and then keeps the cost linear.
        if (cut_ && text_.size() > 2 * limit_ + marker_.size()) trim();
    }

    std::string_view view() {
        if (cut_) trim();
        return text_;
    }

  private:
    void trim() {
        const std::size_t most = limit_ + marker_.size();
        if (text_.size() > most) text_.erase(limit_ / 2 + marker_.size(), text_.size() - most);
    }

    std::size_t limit_;
    std::string marker_, text_;
    bool cut_ = false;
};

}  // namespace mpipov
