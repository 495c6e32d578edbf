#include "hydra.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

namespace mpipov {

void take_leave_of_hydra() {
    // Slurm passes a PMI_FD too, and speaks another language over it.
    const char* text = std::getenv("PMI_FD");
    if (text == nullptr || std::getenv("MPI_LOCALNRANKS") == nullptr) return;
    const int fd = std::atoi(text);
    constexpr std::string_view goodbye = "cmd=finalize\n";
    if (fd <= 0 ||
        ::write(fd, goodbye.data(), goodbye.size()) != static_cast<ssize_t>(goodbye.size()))
        return;
    constexpr int patience_milliseconds = 5000;
    for (std::array<char, 256> answer{};;) {
        pollfd ready{fd, POLLIN, 0};
        if (::poll(&ready, 1, patience_milliseconds) <= 0) return;
        const ssize_t count = ::read(fd, answer.data(), answer.size());
        if (count <= 0 || answer[static_cast<std::size_t>(count) - 1] == '\n') return;
    }
}

}  // namespace mpipov
