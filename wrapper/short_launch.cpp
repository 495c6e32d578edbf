#include "short_launch.h"

#include "interrupt.h"

#include <poll.h>

#include <utility>

namespace mpipov {

ShortLaunch ShortLaunch::start(const ChildRequest& request, std::filesystem::path base) {
    return {std::move(base), ChildProcess::start(request)};
}

bool ShortLaunch::poll() {
    if (!over() && !child.poll()) enough = end.seen(child, base);
    return over();
}

void wait_for_all(std::span<ShortLaunch> launches) {
    for (;;) {
        throw_if_interrupted();
        bool running = false;
        for (ShortLaunch& launch : launches) {
            const bool over = launch.poll();
            running = running || !over;
        }
        if (!running) return;
        sleep_on(launches);
    }
}

void sleep_on(std::span<const ShortLaunch> launches) {
    std::vector<pollfd> fds;
    int wait = 50;
    for (const ShortLaunch& launch : launches) {
        if (launch.over()) continue;
        launch.child.add_poll_fds(fds);
        if (launch.end.near()) wait = near_end_milliseconds;
    }
    ::poll(fds.data(), fds.size(), wait);
}

}  // namespace mpipov
