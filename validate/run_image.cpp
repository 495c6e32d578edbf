#include "run_image.h"

#include "failure.h"
#include "image_file.h"
#include "image_source.h"
#include "json_input.h"
#include "sha1_digits.h"

#include <fmt/format.h>

namespace mpipov {

namespace fs = std::filesystem;

RunRecord read_record(const fs::path& file) {
    try {
        return read_run_record(file);
    } catch (const std::exception& error) {
        throw Failure(Exit::file, plain_words(error.what()));
    }
}

std::string pixel_sha1(const fs::path& image) {
    try {
        const PixelLayout layout = read_layout(image);
        SectionReader reader(image, layout.width, layout.height,
                             {0, 0, layout.width, layout.height});
        OIIO::SHA1 hash;
        while (const auto band = reader.next())
            hash.append(band->pixels.data(), band->pixels.size());
        return sha1_digits(hash);
    } catch (const std::runtime_error& error) {
        throw Failure(Exit::file, error.what());
    }
}

void require_record_of(const RunRecord& run, const fs::path& record, const fs::path& a,
                       const fs::path& b) {
    const auto may_be_of = [&](const fs::path& image) {
        const bool jpeg = ImageSource(image).format().type == "jpeg";
        if (jpeg || run.plan.image.type == "jpeg") return jpeg && run.plan.image.type == "jpeg";
        return pixel_sha1(image) == run.pixel_sha1;
    };
    if (!may_be_of(b) && !may_be_of(a))
        throw Failure(Exit::file,
                      fmt::format("the run record '{}' is of another image: its pixel_sha1 is "
                                  "neither that of '{}' nor that of '{}'; --run takes the record "
                                  "of the run that made B",
                                  record.string(), a.string(), b.string()));
}

}  // namespace mpipov
