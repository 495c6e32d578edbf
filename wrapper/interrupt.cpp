#include "interrupt.h"

#include "failure.h"

#include <csignal>

namespace mpipov {

void block_interrupts() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, signal);
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    // A reader of our messages that goes away (`| head`) must not leave temporary files either.
    std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted() {
    sigset_t set;
    sigemptyset(&set);
    sigpending(&set);
    return sigismember(&set, SIGINT) == 1 || sigismember(&set, SIGTERM) == 1 ||
           sigismember(&set, SIGHUP) == 1;
}

void throw_if_interrupted() {
    if (interrupted()) throw Failure(Exit::interrupted, "interrupted");
}

}  // namespace mpipov
