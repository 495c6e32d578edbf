// mpipov-validate stability SCENE
#pragma once

#include "command.h"

namespace mpipov {

Command add_stability_command(CLI::App& program);

}  // namespace mpipov
