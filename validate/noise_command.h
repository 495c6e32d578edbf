// mpipov-validate noise SCENE
#pragma once

#include "command.h"

namespace mpipov {

Command add_noise_command(CLI::App& program);

}  // namespace mpipov
