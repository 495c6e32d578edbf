#include "paper_machine.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <stdexcept>

namespace mpipov {
namespace {

struct Strip {
    double cpu_seconds = 0;
    double link_seconds = 0;  // of its pixels on rank 0's link
};

// The strips of line y.
std::vector<Strip> strips_of(const CostMap& costs, const PaperMachine& machine, int y, int count) {
    const Rect& region = costs.region();
    count = std::min(count, region.width());
    std::vector<Strip> strips;
    for (int i = 0; i < count; ++i) {
        const int x0 = region.x0 + static_cast<int>(1LL * region.width() * i / count);
        const int x1 = region.x0 + static_cast<int>(1LL * region.width() * (i + 1) / count);
        strips.push_back({costs.cpu_seconds({x0, y, x1, y + 1}),
                          (x1 - x0) * machine.bytes_per_pixel / machine.bytes_per_second});
    }
    return strips;
}

double mpipov1_line(const std::vector<Strip>& strips, double latency) {
    // Whose pixels are sent first comes first.
    std::vector<std::pair<double, double>> arriving;
    for (std::size_t i = 1; i < strips.size(); ++i)
        arriving.emplace_back(strips[i].cpu_seconds + latency, strips[i].link_seconds);
    std::sort(arriving.begin(), arriving.end());
    double link_free = 0;
    for (const auto& [time, seconds] : arriving) link_free = std::max(link_free, time) + seconds;
    return std::max(strips.front().cpu_seconds, link_free);
}

double mpipov2_line(const std::vector<Strip>& strips, double latency, int workers) {
    // When each worker could begin another strip if it were told to.
    std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
    for (int i = 0; i < workers; ++i) free_at.push(0);
    double link_free = 0;
    for (const Strip& strip : strips) {
        const double arrives = free_at.top() + latency + strip.cpu_seconds + latency;
        free_at.pop();
        link_free = std::max(link_free, arrives) + strip.link_seconds;
        free_at.push(link_free);
    }
    double whole = 0;
    for (; !free_at.empty(); free_at.pop()) whole = std::max(whole, free_at.top());
    return whole;
}

double sum_of_lines(const CostMap& costs, const std::function<double(int y)>& line) {
    double sum = 0;
    for (int y = costs.region().y0; y < costs.region().y1; ++y) sum += line(y);
    return sum;
}

}  // namespace

double mpipov1_seconds(const CostMap& costs, const PaperMachine& machine, int ranks) {
    if (ranks < 1) throw std::invalid_argument("MPIPOV1 has at least one rank");
    return sum_of_lines(costs, [&](int y) {
        return mpipov1_line(strips_of(costs, machine, y, ranks), machine.latency);
    });
}

double mpipov2_seconds(const CostMap& costs, const PaperMachine& machine, int ranks, int strips) {
    if (ranks < 2) throw std::invalid_argument("MPIPOV2 has a coordinator and one rank or more");
    if (strips < 1) throw std::invalid_argument("MPIPOV2 has at least one strip");
    return sum_of_lines(costs, [&](int y) {
        return mpipov2_line(strips_of(costs, machine, y, strips), machine.latency, ranks - 1);
    });
}

std::vector<PaperCell> known_paper_cells() {
    return {{1, 8, 6.66, false}, {2, 2, 0.89, true}, {2, 8, 3, false}};
}

std::optional<double> fit_latency(const CostMap& costs, PaperMachine machine, int ranks, int strips,
                                  double speedup) {
    const double serial = costs.cpu_seconds();
    const auto seconds = [&](double latency) {
        machine.latency = latency;
        return mpipov2_seconds(costs, machine, ranks, strips);
    };
    const double wanted = serial / speedup;
    double low = 0, high = wanted;  // a line has at least two messages
    if (seconds(low) > wanted) return {};
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (seconds(middle) > wanted ? high : low) = middle;
    }
    return low;
}

}  // namespace mpipov
