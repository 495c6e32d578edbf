// A temporary folder of our own, removed with all that is in it.
#pragma once

#include "fd.h"

#include <filesystem>
#include <string>

namespace mpipov {

class ScratchFolder {
  public:
    // Below TMPDIR, or /tmp: Debian's povray.conf lets POV-Ray write there and into the current
    // folder, nowhere else. Removes those that killed processes have left there. Throws
    // Failure(Exit::file) where that is not possible.
    explicit ScratchFolder(const std::string& purpose);
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    Fd held_;
};

}  // namespace mpipov
