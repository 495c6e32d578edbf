// The values that options take: from text to Options. Each throws Failure(Exit::usage), which says
// what is possible; the option's name is added by the caller.
#pragma once

#include "options.h"

#include <optional>
#include <string>
#include <vector>

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
void set_confine(Options& options, const std::string& value);
// "auto", "none" or bytes: 512M, 1.5G (powers of 1024).
SizeLimit size_limit(const std::string& value);

// POV-Ray's arguments are passed on literally, whatever their encoding, but for what nobody names a
// file by: none is empty, and none has a control character other than a tab.
void require_passable(const std::vector<std::string>& povray_arguments);

}  // namespace mpipov
