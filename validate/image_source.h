// An image file, read top to bottom in bands of rows, so that memory does not grow with its height
// (but for PNM and TGA files, which OpenImageIO 2.4 itself holds as a whole).
// Values are the stored ones: no gamma, alpha as it lies in the file (unassociated stays so).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mpipov {

struct ImageFormat {
    int width = 0, height = 0;
    std::vector<std::string> channels;  // names, in the file's order
    int alpha = -1;                     // index of the alpha channel, -1 where there is none
    std::string type;                   // as OpenImageIO names it: png, openexr, ...
    std::string depth;                  // uint8, uint16, half, float, double

    int channel_count() const { return static_cast<int>(channels.size()); }
    bool integer() const { return depth == "uint8" || depth == "uint16"; }
    // What 1.0 is in stored units: 255, 65535, or 1 for floats.
    double full_scale() const;
    // The type of ImageBand::raw as NumPy spells it: u1, u2, f4 (half is widened, exactly) or f8.
    std::string raw_type() const;
};

// `rows` rows from row y on; both buffers are rows x width x channels, interleaved.
struct ImageBand {
    int y = 0, rows = 0;
    std::vector<std::byte> raw;  // native byte order
    std::vector<double> values;  // the same in stored units: 0..255, 0..65535, or the float itself

    std::span<const double> row(int r) const;  // r counts from y
};

class ImageSource {
  public:
    // Throws Failure(Exit::file): unreadable, tiled, of mixed or unsupported depth.
    explicit ImageSource(const std::filesystem::path& file);
    ~ImageSource();
    ImageSource(ImageSource&&) noexcept;
    ImageSource& operator=(ImageSource&&) noexcept;

    const std::filesystem::path& file() const { return file_; }
    const ImageFormat& format() const { return format_; }

    // The next rows, at most `rows` of them; false once all were handed out. Reuses the buffers.
    // Throws Failure(Exit::file) where the file ends early.
    bool next_band(int rows, ImageBand& band);

  private:
    struct Input;
    std::filesystem::path file_;
    ImageFormat format_;
    std::unique_ptr<Input> input_;
    int next_row_ = 0;
};

// Writes one channel of floats, width x height, whole or not at all (by rename). The file's name
// says the type; types of 8 bits get [0, 1] as 0..255, clipped. Throws Failure(Exit::file).
void write_gray_image(const std::filesystem::path& file, int width, int height,
                      std::span<const float> values);

// The same of three channels of 16 bits, encoded by the sRGB curve.
void write_colour_image(const std::filesystem::path& file, int width, int height,
                        std::span<const std::uint16_t> values);

}  // namespace mpipov
