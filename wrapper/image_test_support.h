// For tests that read and write image files: bytes, decoded images, and POV-Ray itself.
#pragma once

#include "image_file.h"
#include "scratch.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mpipov {

inline std::span<const std::byte> as_bytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

inline std::string as_text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline void write_text(const std::filesystem::path& file, std::string_view text) {
    std::ofstream(file, std::ios::binary) << text;
}

inline std::string read_text(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// A whole image as OpenImageIO decodes it, values as stored.
struct Decoded {
    OIIO::ImageSpec spec;
    std::vector<std::byte> pixels;
};

inline Decoded decode(const std::filesystem::path& file) {
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(file.string(), &hints);
    if (!input) throw std::runtime_error(OIIO::geterror());
    Decoded image{.spec = input->spec(), .pixels = {}};
    image.pixels.resize(image.spec.image_bytes(true));
    if (!input->read_native_scanlines(0, 0, 0, image.spec.height, 0, image.pixels.data()))
        throw std::runtime_error(input->geterror());
    return image;
}

// An image whose bytes all depend on their position, written by OpenImageIO.
inline std::vector<std::byte> write_pattern(const std::filesystem::path& file,
                                            const PixelLayout& layout, std::string_view type) {
    OIIO::ImageSpec spec(layout.width, layout.height, layout.channels,
                         OIIO::TypeDesc(std::string(to_string(layout.depth))));
    spec.attribute("oiio:UnassociatedAlpha", 1);
    std::vector<std::byte> pixels(spec.image_bytes());
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = static_cast<std::byte>((i * 7 + i / 50) % 60);
    const auto output = OIIO::ImageOutput::create(std::string(type));
    if (!output || !output->open(file.string(), spec) ||
        !output->write_image(spec.format, pixels.data()) || !output->close())
        throw std::runtime_error("cannot write " + file.string());
    return pixels;
}

inline bool povray_on_path() {
    return std::system("command -v povray >/dev/null 2>&1") == 0;
}

// Soft edges of alpha: over nothing, through glass, and where antialiasing mixes.
inline constexpr std::string_view transparent_scene = R"(
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 1, -4> look_at <0, 0.2, 0> right x*image_width/image_height }
light_source { <5, 8, -6> rgb <1.5, 1.4, 1.2> }
background { rgbt 1 }
sphere { <-0.7, 0.2, 0>, 0.8 pigment { rgbt <1, 0.3, 0.1, 0.55> } finish { phong 1 } }
sphere { <0.8, 0.1, 0.5>, 0.7
  pigment { checker rgb <0.1, 0.9, 0.3> rgb <0.05, 0.02, 0.3> scale 0.2 } finish { ambient 0.2 } }
cylinder { <-2, -0.8, 1>, <2, 1.1, 1.3>, 0.05 pigment { rgb <0.9, 0.8, 0.1> } }
)";

// Runs POV-Ray in `folder` on transparent_scene; the file it wrote. `options` are words of a shell.
inline std::filesystem::path render(const std::filesystem::path& folder, const std::string& name,
                                    const std::string& options) {
    write_text(folder / "scene.pov", transparent_scene);
    const auto log = folder / (name + ".log");
    const std::string command = "cd '" + folder.string() + "' && povray +Iscene.pov +O" + name +
                                " +A0.1 +WT1 -D -GA " + options + " >'" + log.string() + "' 2>&1";
    if (std::system(command.c_str()) != 0)
        throw std::runtime_error(command + "\n" + read_text(log));
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().stem() == name && entry.path().extension() != ".log") return entry.path();
    throw std::runtime_error("POV-Ray wrote no file: " + command + "\n" + read_text(log));
}

}  // namespace mpipov
