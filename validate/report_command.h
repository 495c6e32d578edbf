#pragma once

#include "command.h"

namespace mpipov {

Command add_report_command(CLI::App& program);

}  // namespace mpipov
