// Runs one setting of a trade-off once.
#pragma once

#include "serial_render.h"
#include "tradeoff_settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mpipov {

// Appended to every command, so that errors below a level of 255 are seen: PNG of 16 bits, encoded
// by the sRGB curve whatever the user's file is, without alpha.
inline const std::vector<std::string> measured_format{"+FN16", "-UA", "File_Gamma=srgb"};

struct TradeoffTools {
    std::string povray = "povray", mpiexec = "mpiexec";
    std::filesystem::path mpipov;
    SceneRules rules = {};
};

struct TradeoffRun {
    std::filesystem::path image;
    double wall_seconds = 0, cpu_seconds = 0;
    int sections = 0;  // of mpipov
};

class TradeoffRenderer {
  public:
    // `user_arguments` as the user gave them.
    TradeoffRenderer(TradeoffTools tools, std::vector<std::string> user_arguments,
                     std::filesystem::path scratch);

    // The whole command but for the names of what it writes.
    std::vector<std::string> argv(const TradeoffSetting& setting) const;
    // What a user would run to get that picture in the file type of their own.
    std::vector<std::string> user_argv(const TradeoffSetting& setting) const;
    // The image lies in the scratch folder until the next run. Throws Failure: usage where mpipov
    // says that there is no such grid, scene, file, interrupted.
    TradeoffRun run(const TradeoffSetting& setting) const;
    const SerialRenderer& serial() const { return serial_; }

  private:
    TradeoffRun run_serial(const TradeoffSetting& setting) const;
    TradeoffRun run_mpipov(const TradeoffSetting& setting) const;

    TradeoffTools tools_;
    std::vector<std::string> arguments_;
    std::filesystem::path scratch_;
    SerialRenderer serial_;
};

}  // namespace mpipov
