// The manifest of serial renders (noise.json, `noise --out` and `seams --serial`), maps of costs,
// and what two identities of a scene differ in.
#include "cost_map.h"
#include "entry.h"
#include "failure.h"
#include "job_identity.h"
#include "json_input.h"
#include "serial_manifest.h"

namespace {

using namespace mpipov;
using fuzz::require;

template <class Read>
void unless_damaged(const Read& read) {
    try {
        read();
    } catch (const std::runtime_error& error) {  // Failure is one
        require(error.what()[0] != '\0', "an error says something");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    nlohmann::json json;
    try {
        json = parse_json(fuzz::as_text(data, size));
    } catch (const std::runtime_error&) {
        return 0;
    }
    unless_damaged([&] {
        const SerialManifest manifest = manifest_from_json(json);
        require(manifest.references.contains("default"), "there is always a reference");
        require(manifest.tried >= 0 && manifest.wanted >= 0, "numbers of renders are none below 0");
    });
    unless_damaged([&] {
        const CostMap costs = cost_map_from_json(json);
        require(costs.cpu_seconds() >= 0, "costs are not negative");
        require(stretched(costs, {0, 0, 100, 75}).cpu_seconds() >= 0, "nor stretched ones");
    });
    require(what_changed(json, json).empty(), "nothing differs from itself");
    const nlohmann::json other = {{"region", "all"}, {"settings", {{"Width", "320"}}}};
    require(what_changed(json, other).empty() == (json == other) || !json.is_object(),
            "what differs is told");
    return 0;
}
