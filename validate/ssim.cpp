#include "ssim.h"

#include "failure.h"
#include "image_source.h"
#include "interrupt.h"
#include "json_input.h"
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

json request_of(const SsimPair& pair, double peak, const fs::path& folder, std::size_t index) {
    const std::string a = fmt::format("{}.a.raw", index), b = fmt::format("{}.b.raw", index);
    const ImageFormat format = write_raw(pair.a, folder / a);
    write_raw(pair.b, folder / b);
    json colour = json::array();
    for (int c = 0; c < format.channel_count(); ++c)
        if (c != format.alpha) colour.push_back(c);
    if (colour.empty()) colour.push_back(0);
    return {{"width", format.width},
            {"height", format.height},
            {"channels", format.channels.size()},
            {"type", format.raw_type()},
            {"full_scale", format.full_scale()},
            {"data_range", peak},
            {"colour", colour},
            {"a", a},
            {"b", b},
            {"map", pair.map.empty() ? json() : json(fmt::format("{}.map.raw", index))}};
}

Ssim result_of(const json& j) {
    Ssim ssim;
    if (!j.at("ssim").is_null()) ssim.value = j.at("ssim").get<double>();
    ssim.per_channel = j.at("per_channel").get<std::vector<double>>();
    ssim.reason = j.value("reason", "");
    return ssim;
}

void store_map(const json& request, const fs::path& folder, const fs::path& map) {
    const int width = request.at("width"), height = request.at("height");
    write_gray_image(
        map, width, height,
        read_floats(folder / request.at("map").get<std::string>(),
                    static_cast<std::size_t>(width) * static_cast<std::size_t>(height)));
}

}  // namespace

std::vector<Ssim> compute_ssim(const std::vector<SsimPair>& pairs, double peak) {
    if (pairs.empty()) return {};
    const ScratchFolder folder("ssim");
    json requests = json::array();
    for (std::size_t i = 0; i < pairs.size(); ++i)
        requests.push_back(request_of(pairs[i], peak, folder.path(), i));
    const fs::path request_file = folder.path() / "requests.json";
    const fs::path result_file = folder.path() / "results.json";
    std::ofstream(request_file) << requests;
    run_script("ssim.py", {request_file.string(), "--json", result_file.string()});

    std::vector<Ssim> found;
    try {
        std::ifstream in(result_file);
        for (const json& result : json::parse(in)) found.push_back(result_of(result));
        if (found.size() != pairs.size()) throw std::runtime_error("some are missing");
    } catch (const std::exception& error) {
        throw Failure(Exit::file, fmt::format("cannot use the result of ssim.py: {}",
                                              plain_words(error.what())));
    }
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (!pairs[i].map.empty() && found[i].value)
            store_map(requests[i], folder.path(), pairs[i].map);
    return found;
}

Ssim ssim_of_identical() {
    return {1.0, {}, "by definition: the images are identical"};
}

}  // namespace mpipov
