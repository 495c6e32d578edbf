// Messages over MPI. Nothing here blocks: a blocking receive would burn a whole core in MPICH.
#pragma once

#include "transport.h"

#include <memory>
#include <vector>

namespace mpipov {

class MpiTransport : public Transport {
  public:
    // MPI must be initialised and outlive this.
    MpiTransport();
    ~MpiTransport() override;
    MpiTransport(const MpiTransport&) = delete;
    MpiTransport& operator=(const MpiTransport&) = delete;

    int rank() const override;
    int size() const override;
    void send(Message message) override;
    std::optional<Message> try_receive() override;
    std::size_t unsent_bytes() override;

    // The last thing that is done with it, by all ranks: waits for each other, and between hosts
    // lets what MPI itself has to say arrive, so that a rank may end without MPI_Finalize. False
    // where some rank does not come within `seconds`; MPI_Finalize would not return then.
    bool part(double seconds, bool several_hosts);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// Ranks of this host, and which of them we are, in rank order.
struct HostShare {
    int local_rank = 0, local_size = 1;
    // For each local rank, the CPUs that its affinity mask allows.
    std::vector<std::vector<int>> cpus;
};
HostShare host_share();  // collective

}  // namespace mpipov
