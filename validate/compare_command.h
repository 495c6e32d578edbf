// mpipov-validate compare A B
#pragma once

#include "command.h"

namespace mpipov {

Command add_compare_command(CLI::App& program);

}  // namespace mpipov
