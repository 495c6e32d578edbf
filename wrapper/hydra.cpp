#include "hydra.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
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

bool wait_until_read(int fd, double seconds) {
    using Seconds = std::chrono::duration<double>;
    struct stat status {};
    if (::fstat(fd, &status) != 0 || !S_ISFIFO(status.st_mode)) return true;
    const auto begin = std::chrono::steady_clock::now();
    for (int unread = 0; ::ioctl(fd, FIONREAD, &unread) == 0 && unread > 0;) {
        if (Seconds(std::chrono::steady_clock::now() - begin).count() > seconds) return false;
        ::poll(nullptr, 0, 1);
    }
    return true;
}

}  // namespace mpipov
