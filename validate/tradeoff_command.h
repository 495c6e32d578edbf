// mpipov-validate tradeoff SCENE
#pragma once

#include "command.h"

namespace mpipov {

Command add_tradeoff_command(CLI::App& program);

}  // namespace mpipov
