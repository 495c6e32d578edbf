// The JSON file of a measurement (seams.json, speedup.json) in the folder that it was given:
// written again after every step, so that little is lost, but not over an earlier measurement
// before there is something to put in its place.
#pragma once

#include "failure.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace mpipov {

class ResultFile {
  public:
    // `holds_results`: whether what lies there is worth keeping; it may throw json's exceptions, of
    // a damaged file, which is not.
    ResultFile(std::filesystem::path file, bool (*holds_results)(const nlohmann::json& earlier));

    // An earlier measurement that is worth keeping is still there.
    bool keeps_earlier() const { return keeps_earlier_; }
    // From now on write() replaces it. Call it before any of its images or records is touched.
    void replace_earlier() { keeps_earlier_ = false; }

    // Nothing as long as it keeps an earlier one. Throws Failure(Exit::file).
    void write(const nlohmann::json& result) const;

  private:
    std::filesystem::path file_;
    bool keeps_earlier_ = false;
};

// Does the work of a measurement; the report says how it ended, in the file too. Throws what `work`
// throws.
template <class Report, class Work>
void measure_into(ResultFile& file, Report& report, const Work& work) {
    file.write(to_json(report));
    try {
        work();
    } catch (const Failure& failure) {
        report.failure = failure.what();
        file.write(to_json(report));
        throw;
    }
    report.complete = true;
    file.write(to_json(report));
}

}  // namespace mpipov
