// run.json, and what is made of it.
#include "cost_map.h"
#include "entry.h"
#include "json_input.h"
#include "run_record.h"

namespace {

using namespace mpipov;
using fuzz::require;

void use_costs(const RunRecord& record) {
    try {
        const CostMap costs = costs_of_run(record, 0.1);
        require(costs.cpu_seconds() >= 0, "costs are not negative");
        const CostMap twice = stretched(costs, {0, 0, 640, 480});
        require(twice.cpu_seconds() >= 0, "stretched costs are not negative");
    } catch (const std::invalid_argument&) {
        // As cost_map.h says; whoever reads the record does without its costs then.
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const RunRecord record = run_from_json(parse_json(fuzz::as_text(data, size)));
        const nlohmann::json written = to_json(record);
        // As a file has it: what is no UTF-8 was replaced.
        const std::string text =
            written.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
        const RunRecord again = run_from_json(parse_json(std::string_view(text)));
        require(
            to_json(again).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) == text,
            "what was written reads as the same record");
        for (const SectionRecord& section : record.sections)
            require(section.section.keep.area() >= 0 && section.section.render.area() >= 0,
                    "no area overflows");
        use_costs(record);
    } catch (const std::runtime_error& error) {
        require(error.what()[0] != '\0', "an error says something");
    }
    return 0;
}
