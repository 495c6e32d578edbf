// Where serial renders are made, so that those of an earlier set in the same folder stay together
// until all of the new ones are there.
#pragma once

#include "serial_set.h"

#include <filesystem>

namespace mpipov {

class SerialStage {
  public:
    // Below `folder`, made when the first image is; removed at the end with what was not kept.
    explicit SerialStage(const std::filesystem::path& folder);
    ~SerialStage();
    SerialStage(const SerialStage&) = delete;
    SerialStage& operator=(const SerialStage&) = delete;

    const std::filesystem::path& path() const { return path_; }

    // Moves the images of a set that was made here into the folder, over those of the same names.
    // Throws Failure(Exit::file).
    void keep(SerialSet& set) const;

  private:
    std::filesystem::path folder_, path_;
};

}  // namespace mpipov
