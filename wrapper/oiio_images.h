// The two halves of mpipov-images.so: reading and encoding with OpenImageIO. See image_library.h.
#pragma once

#include "row_source.h"
#include "stitch.h"

namespace mpipov {

std::unique_ptr<RowSource> open_oiio_rows(const std::filesystem::path& file);
void write_by_oiio(const Canvas& canvas, const FileStyle& style, const std::filesystem::path& file);

}  // namespace mpipov
