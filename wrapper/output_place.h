// Where the image, the record and the work folder go, and writing the image so that it is either
// there as a whole or not at all.
#pragma once

#include <filesystem>
#include <functional>

namespace mpipov {

class OutputPlace {
  public:
    // Empty paths: run.json and `<image>.mpipov` beside the image, of an image with a very long
    // name its first 248 bytes; in the current folder where the image is a pipe or a device.
    OutputPlace(std::filesystem::path image, std::filesystem::path record,
                std::filesystem::path work_folder);

    const std::filesystem::path& image() const { return image_; }
    const std::filesystem::path& record() const { return record_; }
    const std::filesystem::path& work_folder() const { return work_folder_; }

    // Throws Failure(Exit::file) where image or record could not be written later: better now than
    // after hours of rendering.
    void check() const;

    // `encode` writes to a file beside the image, which then takes its place by rename. Throws
    // Failure(Exit::file) for any std::runtime_error of encode's; whatever is thrown, nothing is
    // left behind and an earlier image stays.
    void write(const std::function<void(const std::filesystem::path&)>& encode) const;

  private:
    std::filesystem::path image_, record_, work_folder_;
};

}  // namespace mpipov
