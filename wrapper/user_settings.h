// Where the user who runs us is at home, and which settings of his POV-Ray reads on its own.
#pragma once

#include <filesystem>

namespace mpipov {

// $HOME, or what the system knows of the user; may be empty.
std::filesystem::path home_of_user();

// POV-Ray's default settings, in the order in which it looks for them: $POVINI, and below `home`.
// Empty where it takes those of the folder of the run or the system's, or none.
std::filesystem::path settings_of_user(const std::filesystem::path& home);

}  // namespace mpipov
