#include "host_cpu.h"

#include <fstream>

namespace mpipov {

std::string cpu_name() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);)
        if (line.rfind("model name", 0) == 0)
            if (const auto at = line.find(": "); at != std::string::npos)
                return line.substr(at + 2);
    return {};
}

}  // namespace mpipov
