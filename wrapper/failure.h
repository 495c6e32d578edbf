// How a program of ours ends: the exit codes of mpipov and mpipov-validate.
// 0 ok, 1 the images differ or a bar is missed, 2 usage, 3 the scene or POV-Ray, 4 a file, the disk
// or too little memory for the image, 5 interrupted or a rank was lost (--resume goes on).
#pragma once

#include <stdexcept>
#include <string>

namespace mpipov {

enum class Exit { ok = 0, differ = 1, usage = 2, scene = 3, file = 4, interrupted = 5 };

// Thrown anywhere, printed once by main, which exits with `code`.
class Failure : public std::runtime_error {
  public:
    Failure(Exit code, const std::string& what, bool rank_lost = false)
        : std::runtime_error(what), code_(code), rank_lost_(rank_lost) {}
    Exit code() const { return code_; }
    // There is a rank that will not answer any more.
    bool rank_lost() const { return rank_lost_; }

  private:
    Exit code_;
    bool rank_lost_;
};

}  // namespace mpipov
