// How messages travel. Sending never blocks; messages from one rank arrive in the order sent.
#pragma once

#include "message.h"

#include <cstddef>
#include <optional>

namespace mpipov {

class Transport {
  public:
    virtual ~Transport() = default;

    virtual int rank() const = 0;
    virtual int size() const = 0;

    // To message.peer; a rank may write to itself.
    virtual void send(Message message) = 0;
    virtual std::optional<Message> try_receive() = 0;

    // Bytes given to send() that have not left yet: a sender of many bands waits while it is large.
    virtual std::size_t unsent_bytes() = 0;
};

}  // namespace mpipov
