// mpipov-validate seams SCENE
#pragma once

#include "command.h"

namespace mpipov {

Command add_seams_command(CLI::App& program);

}  // namespace mpipov
