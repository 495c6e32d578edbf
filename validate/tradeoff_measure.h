// The errors of a trade-off's pictures.
#pragma once

#include "tradeoff_report.h"

#include <filesystem>

namespace mpipov {

// Of a picture against another, over the region that was rendered; without SSIM.
TradeoffError error_of(const TradeoffReport& report, const std::filesystem::path& reference,
                       const std::filesystem::path& image);

// Of every row against the truth and against its serial render, as far as there are both.
void add_errors(TradeoffReport& report);

// SSIM to those errors. Where scikit-image cannot be run it says why instead.
void add_ssim(TradeoffReport& report);

}  // namespace mpipov
