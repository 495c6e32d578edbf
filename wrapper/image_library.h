// What needs OpenImageIO: reading files that are neither PNG nor PNM, and encoding. It lies in a
// library of its own (mpipov-images.so), loaded when it is first needed: OpenImageIO brings some
// 260 shared libraries along, 0.3 CPU seconds and 90 MB for each rank (docs/architecture.md), and
// most ranks never need them.
#pragma once

#include "row_source.h"
#include "stitch.h"

#include <filesystem>
#include <memory>
#include <thread>

namespace mpipov {

class ImageLibrary {
  public:
    virtual ~ImageLibrary() = default;

    // Any type that OpenImageIO knows by its extension. Throws as open_png_rows does.
    virtual std::unique_ptr<RowSource> open_rows(const std::filesystem::path& file) const = 0;
    // stitch.h's write_image.
    virtual void write_image(const Canvas& canvas, const FileStyle& style,
                             const std::filesystem::path& file) const = 0;
};

// Throws std::runtime_error where it cannot be found or loaded.
const ImageLibrary& image_library();

// Loads it on a thread of its own, which this waits for at its end: for whom will need it, while
// POV-Ray sleeps through its start. What goes wrong is told to who needs it.
class LoadingImageLibrary {
  public:
    LoadingImageLibrary();

  private:
    std::jthread thread_;
};

}  // namespace mpipov
