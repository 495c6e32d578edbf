// Compares two image files. A is the reference (the serial render), B what is judged against it.
#pragma once

#include "image_source.h"
#include "metrics.h"
#include "run_record.h"
#include "seam_profile.h"
#include "ssim.h"

#include <filesystem>
#include <optional>

namespace mpipov {

struct CompareRequest {
    std::filesystem::path a, b;
    std::optional<RunRecord> run;  // of B: adds the errors by place
    double peak = 1;               // of PSNR and SSIM; full scale is 1
    int rows_per_band = 64;        // changes memory, not results
};

struct Comparison {
    std::filesystem::path a, b;
    ImageFormat format;  // of both, but for b's file type
    std::string type_b;
    double peak = 1;
    Metrics metrics;
    std::optional<SeamReport> seams;
    std::optional<Ssim> ssim;  // none: not asked for; filled in by the caller

    bool identical() const { return metrics.identical(); }
    std::optional<double> psnr() const { return metrics.psnr(peak * format.full_scale()); }
};

// Reads each file once, in bands. Throws Failure(Exit::file) where one cannot be read, where size,
// channels or depth differ, or where the run record is not of such an image, and
// Failure(Exit::interrupted).
Comparison compare_images(const CompareRequest& request);

}  // namespace mpipov
