// Synthetic images and run records for the tests.
#pragma once

#include "metrics.h"
#include "run_record.h"
#include "section.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace mpipov {

// Values in stored units, rows from the top, channels interleaved.
struct TestImage {
    int width = 0, height = 0, channels = 3;
    std::vector<double> values;

    ImageShape shape() const { return {width, height, channels, channels == 4 ? 3 : -1}; }
    double& at(int x, int y, int c) {
        return values[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x)) *
                          static_cast<std::size_t>(channels) +
                      static_cast<std::size_t>(c)];
    }
    std::span<const double> row(int y) const {
        const auto length = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
        return std::span(values).subspan(static_cast<std::size_t>(y) * length, length);
    }
};

// No two neighbouring pixels are alike, and all values lie in 10..240 of 255.
inline TestImage textured(int width, int height, int channels = 3) {
    TestImage image{width, height, channels, {}};
    std::uint32_t state = 12345;
    const int samples = width * height * channels;
    for (int i = 0; i < samples; ++i) {
        state = state * 1664525U + 1013904223U;
        image.values.push_back(10 + (state >> 8U) % 231);
    }
    return image;
}

inline Metrics measure(const TestImage& a, const TestImage& b) {
    MetricsBuilder builder(a.shape());
    for (int y = 0; y < a.height; ++y) builder.add_row(y, a.row(y), b.row(y));
    return builder.result();
}

// Integer types get the values rounded as they are, float types divided by 255.
inline void write_image(const std::filesystem::path& file, const TestImage& image,
                        const OIIO::TypeDesc& type) {
    OIIO::ImageSpec spec(image.width, image.height, image.channels, type);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    auto output = OIIO::ImageOutput::create(file.string());
    ASSERT_TRUE(output) << OIIO::geterror();
    ASSERT_TRUE(output->open(file.string(), spec)) << output->geterror();
    bool written = false;
    if (type == OIIO::TypeDesc::UINT8) {
        const std::vector<std::uint8_t> pixels(image.values.begin(), image.values.end());
        written = output->write_image(type, pixels.data());
    } else if (type == OIIO::TypeDesc::UINT16) {
        const std::vector<std::uint16_t> pixels(image.values.begin(), image.values.end());
        written = output->write_image(type, pixels.data());
    } else {
        std::vector<float> pixels;
        for (const double value : image.values) pixels.push_back(static_cast<float>(value / 255));
        written = output->write_image(OIIO::TypeDesc::FLOAT, pixels.data());
    }
    ASSERT_TRUE(written && output->close()) << output->geterror();
}

// The record of a finished run that cut width x height pixels into `sections`.
inline RunRecord run_of(int width, int height, Shape shape, int sections,
                        Seams seams = Seams::plain) {
    RunRecord record;
    record.complete = true;
    record.plan.image = {width, height, 3, "png", "uint8"};
    record.plan.region = {0, 0, width, height};
    record.plan.shape = shape;
    record.plan.seams = seams;
    GridRequest request{record.plan.region, shape, seams, sections};
    for (const Section& section : make_partition(request).sections) {
        SectionRecord entry;
        entry.section = section;
        record.sections.push_back(entry);
    }
    record.plan.sections = static_cast<int>(record.sections.size());
    for (const Seam& seam : find_seams(make_partition(request).sections))
        record.seams.push_back({seam});
    return record;
}

}  // namespace mpipov
