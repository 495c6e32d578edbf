#include "image_library.h"

#include "installed_file.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

namespace mpipov {
namespace {

const ImageLibrary& load() {
    const std::filesystem::path file =
        find_installed({.name = "mpipov-images.so", .folder = MPIPOV_LIB_FROM_BIN, .variable = {}});
    // Never unloaded: what it made may outlive any handle to it.
    void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* entry = library != nullptr ? ::dlsym(library, "mpipov_image_library") : nullptr;
    if (entry == nullptr)
        throw std::runtime_error(fmt::format("cannot load '{}': {}", file.string(), ::dlerror()));
    return *reinterpret_cast<const ImageLibrary* (*)()>(entry)();
}

}  // namespace

const ImageLibrary& image_library() {
    static const ImageLibrary& library = load();
    return library;
}

LoadingImageLibrary::LoadingImageLibrary()
    : thread_([] {
          try {
              image_library();
          } catch (const std::runtime_error&) {  // the next to ask tries again
          }
      }) {}

void write_image(const Canvas& canvas, const FileStyle& style, const std::filesystem::path& file) {
    image_library().write_image(canvas, style, file);
}

}  // namespace mpipov
