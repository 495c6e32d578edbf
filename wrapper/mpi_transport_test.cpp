// Run under mpiexec with any number of ranks: every rank runs the same tests, side by side, and all
// of them fail where one does. Nothing here waits without end.
#include "mpi_transport.h"

#include "event_loop.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mpi.h>
#include <poll.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace mpipov {
namespace {

constexpr double patience_seconds = 30;

// Bytes that tell who sent which of how many.
std::vector<std::byte> body(int from, int number, std::size_t size) {
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; ++i)
        bytes[i] = static_cast<std::byte>((i * 31 + i / 251 + static_cast<std::size_t>(from) * 7 +
                                           static_cast<std::size_t>(number)) &
                                          0xffU);
    return bytes;
}

Message numbered(int to, int from, int number, std::size_t size) {
    return {MessageKind::band, to, {{"number", number}}, body(from, number, size)};
}

Message receive(Transport& transport) {
    auto message = wait_for_message(transport, patience_seconds);
    if (!message) throw std::runtime_error("a message did not arrive");
    return std::move(*message);
}

// Everything that we sent has left; takes nothing.
bool all_sent(Transport& transport) {
    const auto until =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_seconds);
    while (transport.unsent_bytes() > 0 && std::chrono::steady_clock::now() < until)
        ::poll(nullptr, 0, 1);
    return transport.unsent_bytes() == 0;
}

// Each test has a transport of its own, of all ranks; at its end nothing is under way.
class MpiTransportTest : public testing::Test {
  protected:
    void TearDown() override {
        EXPECT_TRUE(all_sent(transport_));
        MPI_Barrier(MPI_COMM_WORLD);
        // What was sent before the barrier is there to be seen, or would be within this time.
        EXPECT_FALSE(wait_for_message(transport_, 0.1)) << "a message is left unread";
        MPI_Barrier(MPI_COMM_WORLD);
    }

    int rank() const { return transport_.rank(); }
    int size() const { return transport_.size(); }

    MpiTransport transport_;
};

TEST_F(MpiTransportTest, KnowsItsRanks) {
    int world_rank = -1, world_size = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &world_rank);
    MPI_Comm_size(MPI_COMM_WORLD, &world_size);
    EXPECT_EQ(rank(), world_rank);
    EXPECT_EQ(size(), world_size);
    EXPECT_FALSE(transport_.try_receive());
    EXPECT_EQ(transport_.unsent_bytes(), 0u);
}

TEST_F(MpiTransportTest, CarriesEverySizeBetweenAllPairsInOrder) {
    const std::vector<std::size_t> sizes{0, 1, 63, 64, 4096, 65'536 - 7, 100'000, 1 << 20, 8 << 20};
    const auto count = static_cast<int>(sizes.size());
    for (int number = 0; number < count; ++number)
        for (int to = 0; to < size(); ++to)
            transport_.send(numbered(to, rank(), number, sizes[static_cast<std::size_t>(number)]));
    std::map<int, int> next;
    for (int expected = count * size(); expected > 0; --expected) {
        const Message message = receive(transport_);
        const int number = next[message.peer]++;
        EXPECT_EQ(message.kind, MessageKind::band);
        EXPECT_EQ(message.head.at("number"), number) << "out of order from rank " << message.peer;
        EXPECT_TRUE(message.body ==
                    body(message.peer, number, sizes[static_cast<std::size_t>(number)]))
            << "message " << number << " of rank " << message.peer << " is damaged";
    }
    EXPECT_EQ(next.size(), static_cast<std::size_t>(size()));
}

TEST_F(MpiTransportTest, KeepsTheOrderOfManyShortAndLongMessages) {
    constexpr int count = 400;
    const auto size_of = [](int number) {
        return static_cast<std::size_t>(number % 7 == 0 ? 200'000 : number % 50);
    };
    const int to = (rank() + 1) % size();
    const int from = (rank() + size() - 1) % size();
    for (int number = 0; number < count; ++number)
        transport_.send(numbered(to, rank(), number, size_of(number)));
    for (int number = 0; number < count; ++number) {
        const Message message = receive(transport_);
        ASSERT_EQ(message.peer, from);
        ASSERT_EQ(message.head.at("number"), number);
        ASSERT_TRUE(message.body == body(from, number, size_of(number)));
    }
}

TEST_F(MpiTransportTest, CarriesHeadsOfAnyText) {
    const nlohmann::json head{{"why", std::string("Grüße \"'\\\n\t") + '\x01'}, {"none", nullptr}};
    transport_.send({MessageKind::failed, (rank() + 1) % size(), head, {}});
    const Message message = receive(transport_);
    EXPECT_EQ(message.kind, MessageKind::failed);
    EXPECT_EQ(message.head, head);
    EXPECT_TRUE(message.body.empty());
}

TEST_F(MpiTransportTest, CountsWhatHasNotLeft) {
    constexpr std::size_t size_of_body = std::size_t{8} << 20;
    if (size() == 1) {
        transport_.send(numbered(0, 0, 0, size_of_body));
        EXPECT_EQ(transport_.unsent_bytes(), 0u) << "a rank's words to itself do not leave";
        EXPECT_EQ(receive(transport_).body.size(), size_of_body);
        return;
    }
    // Rank 1 does not listen at first: so much cannot leave before.
    if (rank() == 0) {
        transport_.send(numbered(1, 0, 0, size_of_body));
        EXPECT_GE(transport_.unsent_bytes(), size_of_body);
        EXPECT_LE(transport_.unsent_bytes(), size_of_body + 100);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank() == 1) {
        EXPECT_EQ(receive(transport_).body.size(), size_of_body);
    }
    EXPECT_TRUE(all_sent(transport_));
}

TEST_F(MpiTransportTest, RefusesMessagesThatAreTooLong) {
    for (int to = 0; to < size(); ++to) {
        EXPECT_THROW(transport_.send(numbered(to, rank(), 0, max_message_bytes + 1)),
                     std::runtime_error);
        EXPECT_EQ(transport_.unsent_bytes(), 0u);
    }
    // The longest that there may be: with its head of 12 bytes, and 5 bytes before that.
    const int to = (rank() + 1) % size();
    transport_.send(numbered(to, rank(), 0, max_message_bytes - 17));
    EXPECT_EQ(receive(transport_).body.size(), max_message_bytes - 17);
    if (size() > 1) {
        EXPECT_THROW(transport_.send(numbered(to, rank(), 0, max_message_bytes - 16)),
                     std::runtime_error);
    }
}

TEST_F(MpiTransportTest, RefusesRanksThatThereAreNot) {
    for (const int to : {-1, size(), 1000})
        EXPECT_THROW(transport_.send(numbered(to, rank(), 0, 1)), std::runtime_error);
}

// Every message is its receiver's only, and two transports do not hear each other.
TEST_F(MpiTransportTest, TransportsAreApart) {
    MpiTransport other;
    other.send({MessageKind::hello, (rank() + 1) % size(), {{"number", 1}}, {}});
    transport_.send({MessageKind::bye, (rank() + 1) % size(), {{"number", 2}}, {}});
    EXPECT_EQ(receive(transport_).head.at("number"), 2);
    EXPECT_FALSE(transport_.try_receive());
    EXPECT_EQ(receive(other).head.at("number"), 1);
    EXPECT_TRUE(all_sent(other));
}

TEST_F(MpiTransportTest, AllPart) {
    MpiTransport other;
    EXPECT_TRUE(transport_.part(60, false));
    EXPECT_TRUE(other.part(60, true));
}

// The last rank comes later than the others wait.
TEST_F(MpiTransportTest, NobodyPartsFromARankThatDoesNotCome) {
    if (size() == 1) return;
    MpiTransport other;
    if (rank() != size() - 1) {
        EXPECT_FALSE(other.part(0.2, false));
    }
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank() == size() - 1) {
        other.part(60, false);
    }
    MPI_Barrier(MPI_COMM_WORLD);
}

TEST(HostShare, NamesEveryRankOfThisHostAndItsCores) {
    const HostShare share = host_share();
    EXPECT_GE(share.local_rank, 0);
    EXPECT_LT(share.local_rank, share.local_size);
    ASSERT_EQ(share.cpus.size(), static_cast<std::size_t>(share.local_size));
    for (const std::vector<int>& cpus : share.cpus) EXPECT_FALSE(cpus.empty());
}

// Rank 0 prints as usual, the others only what went wrong.
class Complaints : public testing::EmptyTestEventListener {
  public:
    explicit Complaints(int rank) : rank_(rank) {}
    void OnTestPartResult(const testing::TestPartResult& result) override {
        if (!result.failed()) return;
        const char* file = result.file_name();
        fmt::print(stderr, "rank {}: {}:{}: {}\n", rank_, file != nullptr ? file : "?",
                   result.line_number(), result.message());
    }

  private:
    int rank_;
};

}  // namespace
}  // namespace mpipov

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    testing::InitGoogleTest(&argc, argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank != 0) {
        testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
        const std::unique_ptr<testing::TestEventListener> silenced(
            listeners.Release(listeners.default_result_printer()));
        // GoogleTest deletes it.
        listeners.Append(std::make_unique<mpipov::Complaints>(rank).release());
    }
    int failed = RUN_ALL_TESTS();
    MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    MPI_Finalize();
    return failed;
}
