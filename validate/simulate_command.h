// mpipov-validate simulate
#pragma once

#include "command.h"

namespace mpipov {

Command add_simulate_command(CLI::App& program);

}  // namespace mpipov
