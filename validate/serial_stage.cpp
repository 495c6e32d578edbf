#include "serial_stage.h"

#include "failure.h"

#include <fmt/format.h>
#include <unistd.h>

namespace mpipov {

namespace fs = std::filesystem;

SerialStage::SerialStage(const fs::path& folder)
    : folder_(folder), path_(folder / fmt::format(".serial-{}", ::getpid())) {}

SerialStage::~SerialStage() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

void SerialStage::keep(SerialSet& set) const {
    const auto move = [&](fs::path& image) {
        const fs::path to = folder_ / image.lexically_relative(path_);
        std::error_code error;
        fs::create_directories(to.parent_path(), error);
        fs::rename(image, to, error);
        if (error)
            throw Failure(Exit::file,
                          fmt::format("cannot write '{}': {}", to.string(), error.message()));
        image = to;
    };
    for (auto& [name, render] : set.references) move(render.image);
    for (NoiseRender& noise : set.noise.renders) {
        move(noise.render.image);
        noise.comparison.a = set.reference().image;
        noise.comparison.b = noise.render.image;
    }
}

}  // namespace mpipov
