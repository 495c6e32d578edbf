// How many sections a second the real coordinator can hand out and take in over real MPI: the other
// ranks send back pixels at once instead of rendering them.
//   mpiexec -n N handout_benchmark SECTIONS EDGE [JOURNAL]
// SECTIONS square sections of EDGE pixels, 3 channels of 8 bits; with the folder JOURNAL, which
// must not be there, sections are kept on disk as mpipov keeps them. docs/simulation.md has the
// numbers.

#include "coordinator.h"
#include "known_picture.h"
#include "mpi_transport.h"

#include <fmt/format.h>
#include <mpi.h>
#include <poll.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <string>

namespace {

using namespace mpipov;

double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// To the nanosecond; what getrusage() tells may be a tick old.
double thread_cpu_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Bands and the word that they were all, as a worker sends them.
void answer(Transport& transport, const nlohmann::json& assignment) {
    const Rect render = rect_from_json(assignment.at("render"));
    nlohmann::json head{{"section", assignment.at("section")},
                        {"attempt", assignment.at("attempt")}};
    const long long row = 1LL * render.width() * known_channels;
    const int rows =
        static_cast<int>(std::max(1LL, std::min<long long>(render.height(), max_band_bytes / row)));
    for (int y = render.y0; y < render.y1; y += rows) {
        const Rect rect{render.x0, y, render.x1, std::min(y + rows, render.y1)};
        head["rect"] = rect_to_json(rect);
        transport.send({MessageKind::band, 0, head,
                        std::vector<std::byte>(static_cast<std::size_t>(row * rect.height()))});
    }
    head["wall_seconds"] = head["cpu_seconds"] = 0.0;
    head["warnings"] = nlohmann::json::array();
    transport.send({MessageKind::done, 0, head, {}});
}

void work(Transport& transport) {
    for (;;) {
        const auto message = transport.try_receive();
        if (!message) {
            ::poll(nullptr, 0, transport.unsent_bytes() > 0 ? 0 : 1);
            continue;
        }
        if (message->kind == MessageKind::stop) return;
        if (message->kind == MessageKind::assign) answer(transport, message->head);
    }
}

int coordinate(Transport& transport, int sections, int edge, const std::string& folder) {
    const int across = static_cast<int>(std::ceil(std::sqrt(sections)));
    const int down = (sections + across - 1) / across;
    CoordinatorSetup setup;
    setup.image = {across * edge, down * edge};
    setup.partition.request.region = {0, 0, setup.image.width, setup.image.height};
    for (int i = 0; i < across * down; ++i) {
        const int x = i % across * edge, y = i / across * edge;
        const Rect rect{x, y, x + edge, y + edge};
        setup.partition.sections.push_back({i, rect, rect});
    }
    for (int rank = 0; rank < transport.size(); ++rank)
        setup.ranks.push_back({rank, "benchmark", rank == 0 ? 0 : 1, 0, 0});
    setup.in_flight.assign(setup.ranks.size(), 4);
    Canvas canvas({setup.image.width, setup.image.height, known_channels, Depth::uint8});
    std::optional<Journal> journal;
    if (!folder.empty())
        journal = Journal::create(folder, nlohmann::json::object(), nlohmann::json::object());
    Coordinator coordinator(setup, transport, canvas, journal ? &*journal : nullptr, wall_seconds);
    const double begin = wall_seconds();
    double cpu = thread_cpu_seconds(), busy = 0;
    coordinator.start();
    busy += thread_cpu_seconds() - cpu;
    while (!coordinator.finished()) {
        cpu = thread_cpu_seconds();
        int taken = 0;
        while (const auto message = transport.try_receive()) {
            if (message->kind == MessageKind::job) continue;  // to its own worker, which is none
            coordinator.handle(*message);
            ++taken;
        }
        // Looks in vain are no part of handling a section.
        if (taken > 0) busy += thread_cpu_seconds() - cpu;
    }
    const double wall = wall_seconds() - begin;
    const int count = coordinator.sections_done();
    fmt::print(
        "{} sections of {}x{} pixels on {} ranks{}: {:.3g} ms of CPU each, {:.4g} sections "
        "a second at most; {:.4g} a second of wall time were done\n",
        count, edge, edge, transport.size(), journal ? ", with a journal" : "", 1e3 * busy / count,
        count / busy, count / wall);
    if (journal) journal->remove();
    for (int rank = 1; rank < transport.size(); ++rank)
        transport.send({MessageKind::stop, rank, nlohmann::json::object(), {}});
    return 0;
}

int run(int argc, char** argv) {
    MpiTransport transport;
    if (argc < 3 || transport.size() < 2) {
        if (transport.rank() == 0)
            fmt::print(stderr,
                       "usage: mpiexec -n N handout_benchmark SECTIONS EDGE [JOURNAL], N "
                       "from 2\n");
        return 2;
    }
    if (transport.rank() == 0)
        return coordinate(transport, std::stoi(argv[1]), std::stoi(argv[2]),
                          argc > 3 ? argv[3] : "");
    work(transport);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int code = 2;
    try {
        code = run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "handout_benchmark: {}\n", error.what());
        MPI_Abort(MPI_COMM_WORLD, code);
    }
    MPI_Finalize();
    return code;
}
