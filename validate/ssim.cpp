#include "ssim.h"

#include "failure.h"
#include "image_source.h"
#include "interrupt.h"
#include "python_script.h"
#include "scratch.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int rows_per_band = 64;

ImageFormat write_raw(const fs::path& image, const fs::path& file) {
    ImageSource source(image);
    std::ofstream out(file, std::ios::binary);
    ImageBand band;
    while (source.next_band(rows_per_band, band)) {
        throw_if_interrupted();
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes to the stream's char
        out.write(reinterpret_cast<const char*>(band.raw.data()),
                  static_cast<std::streamsize>(band.raw.size()));
    }
    if (!out.flush())
        throw Failure(Exit::file,
                      fmt::format("cannot write '{}': is the disk full?", file.string()));
    return source.format();
}

std::vector<float> read_floats(const fs::path& file, std::size_t count) {
    std::vector<float> values(count);
    std::ifstream in(file, std::ios::binary);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes from the stream's char
    in.read(reinterpret_cast<char*>(values.data()),
            static_cast<std::streamsize>(count * sizeof(float)));
    if (!in) throw Failure(Exit::file, fmt::format("cannot read '{}'", file.string()));
    return values;
}

}  // namespace

Ssim compute_ssim(const fs::path& a, const fs::path& b, double peak, const fs::path& map) {
    const ScratchFolder folder("ssim");
    const ImageFormat format = write_raw(a, folder.path() / "a.raw");
    write_raw(b, folder.path() / "b.raw");
    json colour = json::array();
    for (int c = 0; c < format.channel_count(); ++c)
        if (c != format.alpha) colour.push_back(c);
    if (colour.empty()) colour.push_back(0);
    const json request{{"width", format.width},
                       {"height", format.height},
                       {"channels", format.channels.size()},
                       {"type", format.raw_type()},
                       {"full_scale", format.full_scale()},
                       {"data_range", peak},
                       {"colour", colour},
                       {"a", "a.raw"},
                       {"b", "b.raw"}};
    const fs::path request_file = folder.path() / "request.json";
    const fs::path result_file = folder.path() / "result.json";
    const fs::path map_file = folder.path() / "map.raw";
    std::ofstream(request_file) << request;
    std::vector<std::string> arguments{request_file.string(), "--json", result_file.string()};
    if (!map.empty()) arguments.insert(arguments.end(), {"--map", map_file.string()});
    run_script("ssim.py", arguments);

    Ssim ssim;
    try {
        std::ifstream in(result_file);
        const json result = json::parse(in);
        if (!result.at("ssim").is_null()) ssim.value = result.at("ssim").get<double>();
        ssim.per_channel = result.at("per_channel").get<std::vector<double>>();
        ssim.reason = result.value("reason", "");
    } catch (const json::exception& error) {
        throw Failure(Exit::file,
                      fmt::format("cannot use the result of ssim.py: {}", error.what()));
    }
    if (!map.empty() && ssim.value)
        write_gray_image(map, format.width, format.height,
                         read_floats(map_file, static_cast<std::size_t>(format.width) *
                                                   static_cast<std::size_t>(format.height)));
    return ssim;
}

}  // namespace mpipov
