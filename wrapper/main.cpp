// mpipov: parses the command line, and runs the coordinator (rank 0) and a worker (every rank).
#include "confinement.h"
#include "end_on_interrupt.h"
#include "event_loop.h"
#include "failure.h"
#include "hydra.h"
#include "interrupt.h"
#include "mpi_transport.h"
#include "options.h"
#include "printable.h"
#include "probe.h"
#include "render_job.h"
#include "scene_view.h"
#include "scratch.h"
#include "slots.h"
#include "standard_output.h"

#include <OpenImageIO/oiioversion.h>
#include <fmt/format.h>
#include <malloc.h>
#include <mpi.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace mpipov;

std::string mpi_version() {
    std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
    int length = 0;
    MPI_Get_library_version(text.data(), &length);
    const std::string whole(text.data(), static_cast<std::size_t>(length));
    // "MPICH Version:      4.0.2\nMPICH Release date: ..."
    std::string line = whole.substr(0, whole.find('\n'));
    std::string name = line.substr(0, line.find(' '));
    return name + " " + line.substr(line.find_last_of(" \t") + 1);
}

std::string host_name() {
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
}

void print_versions(const std::string& povray) {
    std::string povray_line;
    try {
        povray_line = povray_version(povray);
    } catch (const Failure& failure) {
        povray_line = fmt::format("none ({})", failure.what());
    }
    print_result(fmt::format("mpipov {}\nPOV-Ray {}\n{}\nOpenImageIO {}\n", MPIPOV_VERSION,
                             povray_line, mpi_version(), OIIO_VERSION_STRING));
}

// This thread and every process that it starts. Where the kernel refuses, --slots is a wish.
void keep_to(const std::vector<int>& cpus) {
    if (cpus.empty()) return;
    cpu_set_t set;
    CPU_ZERO(&set);
    for (const int cpu : cpus) CPU_SET(cpu, &set);
    sched_setaffinity(0, sizeof set, &set);
}

struct Self {
    RankRecord record;
    int pool = 1;  // cores, see PlanRequest::pools
    int ranks_of_host = 1;
};

Self about_this_rank(const Options& options, int rank) {
    const HostShare share = host_share();
    // A launch more than there are slots is under way while others start up (--in-flight): only the
    // kernel can keep them all to so many cores.
    if (options.slots) keep_to(slot_cpus(share.cpus, share.local_rank, *options.slots));
    const int slots = options.slots.value_or(fair_slots(share.cpus, share.local_rank));
    return {{rank, host_name(), slots, 0, 0},
            options.slots.value_or(pooled_slots(share.cpus, share.local_rank)),
            share.local_size};
}

Confinement confinement_of(const Options& options, const Self& self, const ScratchFolder& scratch) {
    const int cores = std::max(self.pool, self.record.slots * self.ranks_of_host);
    Options seen_here = options;
    // Another host need not have what the user allows: the scene may be sent there.
    if (self.record.rank != 0)
        for (auto* allowed : {&seen_here.allow_read, &seen_here.allow_write})
            std::erase_if(*allowed, [](const std::filesystem::path& path) {
                std::error_code error;
                return !std::filesystem::exists(path, error);
            });
    return {seen_here, resources_of_host(cores), scratch.path()};
}

// Does not throw where nobody listens.
void complain(const std::string& what) {
    std::fputs(fmt::format("mpipov: {}\n", printable(what)).c_str(), stderr);
}

// For the last words of others; where one of them is lost; after a signal, when the user waits.
constexpr double patience_seconds = 60, lost_seconds = 3, interrupted_seconds = 1;
constexpr double no_limit = 1e9;

void send_refusal(Transport& transport, const RankRecord& self, Exit code, const std::string& why) {
    transport.send({MessageKind::refused,
                    0,
                    {{"host", self.host}, {"why", why}, {"code", static_cast<int>(code)}},
                    {}});
    // MPI must not be left with an unread message, and rank 0 will send one more, though not before
    // its probe is over.
    while (const auto message = wait_for_message(transport, no_limit, interrupted_seconds))
        if (message->kind == MessageKind::stop) return;
}

// MPI_Finalize would wait for a rank that does not answer, for ever where its host is gone.
[[noreturn]] void abandon(const std::string& what) {
    complain(what);
    // hydra looks at the abort before it looks at what was said: one run of ten lost the message.
    constexpr double read_seconds = 3;
    wait_until_read(STDERR_FILENO, read_seconds);
    // MPI_Abort asks hydra on this host, which waits for mpiexec: on a host that is cut off the
    // alarm ends us.
    constexpr unsigned abort_seconds = 2;
    ::alarm(abort_seconds);
    MPI_Abort(MPI_COMM_WORLD, static_cast<int>(Exit::interrupted));
    std::abort();  // MPI_Abort does not return
}

// What every rank but 0 does. Whatever stands in its way, rank 0 hears of it.
void serve(const Options& options, const Self& self, Transport& transport) {
    const RankRecord& record = self.record;
    try {
        const ScratchFolder scratch(fmt::format("rank{}", record.rank));
        Worker worker(transport, scratch.path(), confinement_of(options, self, scratch));
        const std::string povray = povray_version(options.povray);
        transport.send({MessageKind::hello,
                        0,
                        {{"slots", record.slots},
                         {"pool", self.pool},
                         {"host", record.host},
                         {"view", point_of_view()},
                         {"povray", povray}},
                        {}});
        run_event_loop({transport, worker});
    } catch (const Failure& failure) {
        if (failure.rank_lost())
            abandon(fmt::format("host {} (rank {}): {}", record.host, record.rank, failure.what()));
        send_refusal(transport, record, failure.code(), failure.what());
    } catch (const std::exception& error) {
        send_refusal(transport, record, Exit::interrupted, error.what());
    }
}

// Tells the other ranks to stop and hears them out: MPI must not be left with unread messages.
// False where one of them does not answer.
bool dismiss(Transport& transport, double seconds) {
    send_stops(transport);
    for (int waiting = transport.size() - 1; waiting > 0;) {
        const auto message = wait_for_message(transport, seconds, interrupted_seconds);
        if (!message) return false;
        if (message->kind == MessageKind::bye) --waiting;
    }
    return true;
}

// What rank 0 does.
void coordinate(const Options& options, const std::vector<std::string>& arguments, const Self& self,
                Transport& transport) {
    const ScratchFolder scratch("rank0");
    Worker worker(transport, scratch.path(),
                  confinement_of(options, self, scratch));  // its end ends its launches
    JobSetup setup;
    setup.options = options;
    setup.command = arguments;
    setup.command.insert(setup.command.begin(), "mpipov");
    setup.versions = {
        {"mpipov", MPIPOV_VERSION}, {"mpi", mpi_version()}, {"openimageio", OIIO_VERSION_STRING}};
    setup.rank0 = self.record;
    setup.pool0 = self.pool;
    setup.ranks_of_host = self.ranks_of_host;
    run_job(setup, transport, worker);
}

// `several_hosts` tells of the ranks once they have met.
int run(const std::vector<std::string>& arguments, int rank, bool& several_hosts) {
    const Options options = parse_options(arguments);
    if (options.help || options.version || options.manual) {
        if (rank == 0 && options.help) print_result(help_text());
        if (rank == 0 && options.manual) print_result(manual_page());
        if (rank == 0 && options.version) print_versions(options.povray);
        return 0;
    }
    const Self self = about_this_rank(options, rank);
    MpiTransport transport;
    several_hosts = self.ranks_of_host != transport.size();
    if (rank != 0) {
        serve(options, self, transport);
        transport.send({MessageKind::bye, 0, nlohmann::json::object(), {}});
        if (!transport.part(2 * patience_seconds, several_hosts))
            abandon(fmt::format("host {} (rank {}): the others did not come to the end",
                                self.record.host, rank));
        return 0;
    }
    const auto part = [&](double seconds, const std::string& what) {
        if (!dismiss(transport, seconds) || !transport.part(seconds, several_hosts)) abandon(what);
    };
    try {
        coordinate(options, arguments, self, transport);
    } catch (const Failure& failure) {
        part(failure.rank_lost() ? lost_seconds : patience_seconds, failure.what());
        throw;
    } catch (const std::exception& error) {
        part(patience_seconds, error.what());
        throw;
    }
    // Between hosts a rank that is lost by now was not heard of either.
    const double most = several_hosts && options.lost_after_seconds > 0
                            ? std::min(patience_seconds, options.lost_after_seconds)
                            : patience_seconds;
    part(most, "a rank did not answer at the end; the image is complete");
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    block_interrupts();
    // Bands of pixels come and go: glibc would raise the threshold after the first one and keep the
    // later ones in a heap that fragments.
    mallopt(M_MMAP_THRESHOLD, 256 << 10);
    {
        // MPI's own threads must not take the signals either, so they are blocked before.
        const EndOnInterrupt watch(static_cast<int>(Exit::interrupted));
        int provided = 0;
        MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    }
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    int code = 0;
    bool several_hosts = false;
    try {
        code = run(std::vector<std::string>(argv + 1, argv + argc), rank, several_hosts);
    } catch (const Failure& failure) {
        // Of what every rank finds out by itself, one says it.
        if (rank == 0) complain(failure.what());
        code = static_cast<int>(failure.code());
    } catch (const std::exception& error) {
        complain(fmt::format("rank {}: {}", rank, error.what()));
        code = static_cast<int>(Exit::interrupted);
    }
    if (several_hosts) {
        // All have parted (MpiTransport::part). Between hosts MPICH 4.0's MPI_Finalize can wait for
        // ever: a rank that has closed its connections answers no other one that has not
        // (docs/clusters.md).
        take_leave_of_hydra();
        std::fflush(nullptr);
        std::_Exit(code);
    }
    const EndOnInterrupt watch(code);
    MPI_Finalize();
    return code;
}
