// The values that options take: from text to Options. Each throws Failure(Exit::usage), which says
// what is possible; the option's name is added by the caller.
#pragma once

#include "options.h"

#include <optional>
#include <string>

namespace mpipov {

// `wanted` finishes "'x' is not ...".
int whole(const std::string& value, int least, const char* wanted);
std::optional<int> whole_or_auto(const std::string& value, const char* wanted);

void set_seams(Options& options, const std::string& value);
void set_shape(Options& options, const std::string& value);
void set_radiosity(Options& options, const std::string& value);
void set_schedule(Options& options, const std::string& value);
void set_ship(Options& options, const std::string& value);
void set_progress(Options& options, const std::string& value);
void set_lost_after(Options& options, const std::string& value);
void set_timeout(Options& options, const std::string& value);

}  // namespace mpipov
