#include "end_on_interrupt.h"

#include "interrupt.h"

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>

namespace mpipov {

namespace {

constexpr auto look_every = std::chrono::milliseconds(50);
// So that a call which is only slow, on a busy host, comes to its ordinary end.
constexpr int looks_before_the_end = 60;

}  // namespace

EndOnInterrupt::EndOnInterrupt(int code)
    : watch_([code](const std::stop_token& over) {
          std::mutex mutex;
          std::condition_variable_any wake;
          std::unique_lock lock(mutex);
          for (int looks = 0; looks < looks_before_the_end; looks += interrupted() ? 1 : 0) {
              wake.wait_for(lock, over, look_every, [] { return false; });
              if (over.stop_requested()) return;
          }
          std::fputs("mpipov: interrupted while MPI did not answer\n", stderr);
          std::fflush(nullptr);
          std::_Exit(code);
      }) {}

}  // namespace mpipov
