#include "part_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <random>
#include <stdexcept>
#include <system_error>

namespace mpipov {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& target, const std::string& why) {
    throw std::runtime_error(fmt::format("cannot write '{}': {}", target.string(), why));
}

}  // namespace

PartFile::PartFile(std::filesystem::path target) : target_(std::move(target)) {
    std::random_device random;
    for (;;) {
        part_ = target_.parent_path() / fmt::format(".mpipov-{:08x}", random());
        // Not mkstemp: the file is to have the access rights that any new file has.
        const int file = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file >= 0) {
            ::close(file);
            return;
        }
        if (errno != EEXIST) refuse(target_, std::strerror(errno));
    }
}

PartFile::~PartFile() {
    std::error_code ignored;
    if (!part_.empty()) std::filesystem::remove(part_, ignored);
}

void PartFile::take_place() {
    std::error_code error;
    std::filesystem::rename(part_, target_, error);
    if (error) refuse(target_, error.message());
    part_.clear();
}

}  // namespace mpipov
