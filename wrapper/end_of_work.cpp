#include "end_of_work.h"

#include "povray_text.h"
#include "worker.h"

namespace mpipov {

bool EndOfWork::seen(const ChildProcess& child, const std::filesystem::path& base) {
    // Longer than POV-Ray needs from closing a file to removing it.
    constexpr std::chrono::milliseconds moment(10);
    near_ = near_ || statistics_are_printed(child.output());
    if (!near_ || child.has_file_open() || !look_for_image(base)) {
        since_.reset();
        return false;
    }
    const auto now = std::chrono::steady_clock::now();
    if (!since_) since_ = now;
    return now - *since_ >= moment;
}

}  // namespace mpipov
