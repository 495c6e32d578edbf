// An image file, read row by row from the top. Values are handed on as they are stored, in the
// machine's byte order.
#pragma once

#include "image_file.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

namespace mpipov {

class RowSource {
  public:
    explicit RowSource(std::filesystem::path file) : file_(std::move(file)) {}
    virtual ~RowSource() = default;
    RowSource(const RowSource&) = delete;
    RowSource& operator=(const RowSource&) = delete;

    const std::filesystem::path& file() const { return file_; }
    const PixelLayout& layout() const { return layout_; }

    // Rows y0..y1 of the frame into `out`, which holds just these. Never goes back: y0 is at least
    // the y1 of the call before. Throws std::runtime_error naming the file.
    virtual void read(int y0, int y1, std::span<std::byte> out) = 0;

  protected:
    PixelLayout layout_;

  private:
    std::filesystem::path file_;
};

// Throws std::runtime_error "cannot read '<file>': <why>".
[[noreturn]] void cannot_read(const std::filesystem::path& file, std::string_view why);

// The readers throw std::runtime_error where the file is damaged or of a kind that POV-Ray does not
// write. PGM and PPM, binary:
std::unique_ptr<RowSource> open_pnm_rows(const std::filesystem::path& file);
std::unique_ptr<RowSource> open_png_rows(const std::filesystem::path& file);

}  // namespace mpipov
