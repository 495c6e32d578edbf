#include "speedup_variants.h"

#include "povray_command.h"

#include <fmt/format.h>

namespace mpipov {
namespace {

namespace fs = std::filesystem;
using Kind = SpeedupVariant::Kind;

void append(std::vector<std::string>& argv, const std::vector<std::string>& more) {
    argv.insert(argv.end(), more.begin(), more.end());
}

// The same for all, so that none has less to say: no display, no pause, no continued trace.
std::vector<std::string> povray_argv(const SpeedupTools& tools, const SpeedupScene& scene,
                                     int threads) {
    std::vector<std::string> argv{tools.povray};
    append(argv, quote_arguments(scene.arguments));
    append(argv, {"-D", "-P", "-C", "+V", "Create_Ini=", "All_Console=on"});
    argv.push_back(fmt::format("+WT{}", threads));
    return argv;
}

}  // namespace

std::string SpeedupVariant::what() const {
    switch (kind) {
        case Kind::serial:
            return "POV-Ray, serial (+WT1)";
        case Kind::threads:
            return "POV-Ray's own threads (+WTn)";
        case Kind::bands:
            return "equal bands, shell script";
        case Kind::mpipov:
            break;
    }
    return fmt::format("mpipov {}{}", schedule, dedicated ? ", dedicated coordinator" : "");
}

std::string SpeedupVariant::name() const {
    switch (kind) {
        case Kind::serial:
            return "serial";
        case Kind::threads:
            return fmt::format("threads-{}", ranks);
        case Kind::bands:
            return fmt::format("bands-{}", ranks);
        case Kind::mpipov:
            break;
    }
    return fmt::format("mpipov-{}{}-{}", schedule, dedicated ? "-dedicated" : "", ranks);
}

std::vector<SpeedupVariant> speedup_variants(const SpeedupChoice& choice) {
    std::vector<SpeedupVariant> variants{{Kind::serial, 1, {}, false}};
    for (const int n : choice.ranks) variants.push_back({Kind::threads, n, {}, false});
    for (const int n : choice.ranks) variants.push_back({Kind::bands, n, {}, false});
    for (const Policy policy : choice.schedules) {
        const std::string schedule(to_string(policy));
        for (const int n : choice.ranks) variants.push_back({Kind::mpipov, n, schedule, false});
        if (!choice.dedicated) continue;
        for (const int n : choice.ranks)
            if (n > 1) variants.push_back({Kind::mpipov, n, schedule, true});
    }
    return variants;
}

std::vector<std::string> speedup_command(const SpeedupVariant& variant, const SpeedupTools& tools,
                                         const SpeedupScene& scene, const fs::path& folder,
                                         const fs::path& record) {
    const fs::path base = folder / "image";
    if (variant.kind == Kind::serial || variant.kind == Kind::threads) {
        std::vector<std::string> argv = povray_argv(tools, scene, variant.ranks);
        argv.push_back(fmt::format("+O\"{}\"", base.string()));
        return argv;
    }
    if (variant.kind == Kind::bands) {
        std::vector<std::string> argv{"sh",
                                      tools.bands.string(),
                                      fmt::format("{}", variant.ranks),
                                      fmt::format("{}", scene.width),
                                      fmt::format("{}", scene.region.y0),
                                      fmt::format("{}", scene.region.y1),
                                      base.string() + scene.extension};
        append(argv, povray_argv(tools, scene, 1));
        return argv;
    }
    std::vector<std::string> argv{tools.mpiexec,
                                  "-n",
                                  fmt::format("{}", variant.ranks),
                                  tools.mpipov.string(),
                                  "--schedule",
                                  variant.schedule,
                                  "--slots",
                                  tools.slots};
    if (variant.dedicated) argv.emplace_back("--dedicated-coordinator");
    append(argv, {"--record", record.string(), "--povray", tools.povray, "--progress", "none"});
    append(argv, tools.rules.given);
    append(argv, scene.arguments);
    argv.push_back(fmt::format("+O{}", base.string()));
    return argv;
}

}  // namespace mpipov
