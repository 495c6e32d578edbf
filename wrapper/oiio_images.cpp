#include "oiio_images.h"

#include "image_library.h"

namespace {

using namespace mpipov;

class OiioImages final : public ImageLibrary {
  public:
    std::unique_ptr<RowSource> open_rows(const std::filesystem::path& file) const override {
        return open_oiio_rows(file);
    }
    void write_image(const Canvas& canvas, const FileStyle& style,
                     const std::filesystem::path& file) const override {
        write_by_oiio(canvas, style, file);
    }
};

}  // namespace

// What image_library.cpp looks up.
extern "C" __attribute__((visibility("default"))) const ImageLibrary* mpipov_image_library() {
    static const OiioImages images;
    return &images;
}
