// mpipov-validate speedup SCENE
#pragma once

#include "command.h"

namespace mpipov {

Command add_speedup_command(CLI::App& program);

}  // namespace mpipov
