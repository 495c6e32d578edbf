// A file out of the way for a while.
#pragma once

#include <filesystem>
#include <system_error>

namespace mpipov {

// An earlier file that must not be taken for a new one of its name. It is back at the end, over a
// new one, unless it was dropped.
class SetAside {
  public:
    explicit SetAside(std::filesystem::path file)
        : file_(std::move(file)), aside_(file_.string() + ".earlier") {
        std::error_code none;
        std::filesystem::rename(file_, aside_, none);
    }
    ~SetAside() {
        std::error_code none;
        if (!dropped_) std::filesystem::rename(aside_, file_, none);
    }
    SetAside(const SetAside&) = delete;
    SetAside& operator=(const SetAside&) = delete;

    void drop() {
        std::error_code none;
        std::filesystem::remove(aside_, none);
        dropped_ = true;
    }

  private:
    std::filesystem::path file_, aside_;
    bool dropped_ = false;
};

}  // namespace mpipov
