// What is asked about a scene before a trade-off is measured.
#pragma once

#include "confinement.h"
#include "tradeoff_report.h"

#include <filesystem>
#include <string>

namespace mpipov {

// Fills in what the report says of the scene: name, size, region, effects, identity, notes.
// `scratch`: a folder for the probe. Throws Failure as run_probe.
void ask_scene(const std::string& povray, const std::filesystem::path& scratch,
               const Confinement& confinement, TradeoffReport& report);

}  // namespace mpipov
