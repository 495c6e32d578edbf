#include "mpi_transport.h"

#include <mpi.h>
#include <poll.h>
#include <sched.h>

#include <chrono>
#include <deque>
#include <list>
#include <numeric>
#include <stdexcept>

namespace mpipov {
namespace {

constexpr int message_tag = 1;

void check(int code, const char* what) {
    if (code == MPI_SUCCESS) return;
    char text[MPI_MAX_ERROR_STRING] = {};
    int length = 0;
    MPI_Error_string(code, text, &length);
    throw std::runtime_error(std::string(what) + ": " + text);
}

[[noreturn]] void refuse_length() {
    throw std::runtime_error("a message between ranks is too long");
}

}  // namespace

struct MpiTransport::State {
    struct Sending {
        std::vector<std::byte> bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };

    MPI_Comm comm = MPI_COMM_NULL;
    int rank = 0, size = 1;
    std::list<Sending> sending;
    std::deque<Message> to_self;

    void drop_sent() {
        for (auto it = sending.begin(); it != sending.end();) {
            int sent = 0;
            check(MPI_Test(&it->request, &sent, MPI_STATUS_IGNORE), "MPI_Test");
            it = sent != 0 ? sending.erase(it) : std::next(it);
        }
    }
};

MpiTransport::MpiTransport() : state_(std::make_unique<State>()) {
    check(MPI_Comm_dup(MPI_COMM_WORLD, &state_->comm), "MPI_Comm_dup");
    MPI_Comm_set_errhandler(state_->comm, MPI_ERRORS_RETURN);
    MPI_Comm_rank(state_->comm, &state_->rank);
    MPI_Comm_size(state_->comm, &state_->size);
}

MpiTransport::~MpiTransport() {
    // The analyzer sees one function at a time: the request is begun in send().
    for (State::Sending& sending : state_->sending)
        MPI_Wait(&sending.request, MPI_STATUS_IGNORE);  // NOLINT(clang-analyzer-optin.mpi*)
    MPI_Comm_free(&state_->comm);
}

int MpiTransport::rank() const {
    return state_->rank;
}
int MpiTransport::size() const {
    return state_->size;
}

void MpiTransport::send(Message message) {
    if (message.peer < 0 || message.peer >= state_->size)
        throw std::runtime_error("a message to a rank that there is not");
    if (message.peer == state_->rank) {
        if (message.body.size() > max_message_bytes) refuse_length();
        state_->to_self.push_back(std::move(message));
        return;
    }
    std::vector<std::byte> bytes = pack(message);
    // The receiver would refuse it, too late for the sender to tell which message it was.
    if (bytes.size() > max_message_bytes) refuse_length();
    State::Sending& sending = state_->sending.emplace_back();
    sending.bytes = std::move(bytes);
    // NOLINTNEXTLINE(clang-analyzer-optin.mpi*): waited for in drop_sent() and at the end
    check(MPI_Isend(sending.bytes.data(), static_cast<int>(sending.bytes.size()), MPI_BYTE,
                    message.peer, message_tag, state_->comm, &sending.request),
          "MPI_Isend");
}

std::optional<Message> MpiTransport::try_receive() {
    state_->drop_sent();
    if (!state_->to_self.empty()) {
        Message message = std::move(state_->to_self.front());
        state_->to_self.pop_front();
        return message;
    }
    int found = 0;
    MPI_Message handle = MPI_MESSAGE_NULL;
    MPI_Status status;
    check(MPI_Improbe(MPI_ANY_SOURCE, message_tag, state_->comm, &found, &handle, &status),
          "MPI_Improbe");
    if (found == 0) return {};
    int count = 0;
    MPI_Get_count(&status, MPI_BYTE, &count);
    if (count < 0 || static_cast<std::size_t>(count) > max_message_bytes) refuse_length();
    std::vector<std::byte> bytes(static_cast<std::size_t>(count));
    check(MPI_Mrecv(bytes.data(), count, MPI_BYTE, &handle, &status), "MPI_Mrecv");
    return unpack(bytes, status.MPI_SOURCE);
}

std::size_t MpiTransport::unsent_bytes() {
    state_->drop_sent();
    return std::accumulate(
        state_->sending.begin(), state_->sending.end(), std::size_t{0},
        [](std::size_t sum, const State::Sending& s) { return sum + s.bytes.size(); });
}

bool MpiTransport::part(double seconds, bool several_hosts) {
    using Seconds = std::chrono::duration<double>;
    const auto begin = std::chrono::steady_clock::now();
    const auto since = [&begin] {
        return Seconds(std::chrono::steady_clock::now() - begin).count();
    };
    MPI_Request request = MPI_REQUEST_NULL;
    check(MPI_Ibarrier(state_->comm, &request), "MPI_Ibarrier");
    for (int met = 0; met == 0;) {
        check(MPI_Test(&request, &met, MPI_STATUS_IGNORE), "MPI_Test");
        if (met == 0 && since() > seconds) return false;
        if (met == 0) ::poll(nullptr, 0, 1);
    }
    if (!several_hosts) return true;  // shared memory connects nothing
    // On a busy machine time may pass without a look at the network.
    constexpr double last_words_seconds = 0.1;
    constexpr int looks = 50;
    const double end = since() + last_words_seconds;
    for (int look = 0; look < looks || since() < end; ++look) {
        int found = 0;
        check(MPI_Iprobe(MPI_ANY_SOURCE, message_tag, state_->comm, &found, MPI_STATUS_IGNORE),
              "MPI_Iprobe");
        ::poll(nullptr, 0, 1);
    }
    return true;
}

HostShare host_share() {
    MPI_Comm host = MPI_COMM_NULL;
    check(MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host),
          "MPI_Comm_split_type");
    HostShare share;
    MPI_Comm_rank(host, &share.local_rank);
    MPI_Comm_size(host, &share.local_size);
    std::vector<unsigned char> mine(CPU_SETSIZE, 0);
    cpu_set_t set;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
            mine[static_cast<std::size_t>(cpu)] = CPU_ISSET(cpu, &set) ? 1 : 0;
    std::vector<unsigned char> all(mine.size() * static_cast<std::size_t>(share.local_size));
    check(MPI_Allgather(mine.data(), CPU_SETSIZE, MPI_UNSIGNED_CHAR, all.data(), CPU_SETSIZE,
                        MPI_UNSIGNED_CHAR, host),
          "MPI_Allgather");
    MPI_Comm_free(&host);
    for (int rank = 0; rank < share.local_size; ++rank) {
        std::vector<int>& cpus = share.cpus.emplace_back();
        for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
            if (all[static_cast<std::size_t>(rank) * CPU_SETSIZE + static_cast<std::size_t>(cpu)] !=
                0)
                cpus.push_back(cpu);
    }
    return share;
}

}  // namespace mpipov
