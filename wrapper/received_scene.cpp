#include "received_scene.h"

#include "failure.h"
#include "sha1_digits.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace mpipov {
namespace {

namespace fs = std::filesystem;

Failure cannot_write(const fs::path& file, int error) {
    return {Exit::file, fmt::format("cannot write '{}', of the scene that was sent: {}",
                                    file.string(), std::strerror(error))};
}

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw cannot_write(folder, error.value());
}

void require_space(const fs::path& folder, std::uint64_t bytes) {
    std::error_code error;
    const fs::space_info space = fs::space(folder, error);
    if (!error && space.available < bytes)
        throw Failure(Exit::file, fmt::format("the scene that is sent takes {} bytes, and '{}' has "
                                              "{} left: set TMPDIR to another folder",
                                              bytes, folder.string(), space.available));
}

}  // namespace

void ReceivedScene::begin(const fs::path& folder, ScenePack pack, const PackLimits& limits) {
    check(pack, limits);
    std::error_code error;
    // Nobody else's folder, in which a name could be a link.
    if (!fs::create_directory(folder, error))
        throw cannot_write(folder, error ? error.value() : EEXIST);
    require_space(folder, bytes_of(pack));
    folder_ = folder;
    pack_ = std::move(pack);
    begun_ = true;
    next_ = 0;
    for (const std::string& name : pack_.folders) make_folder(folder_ / name);
    open_next();
}

// A file without bytes is complete at once.
void ReceivedScene::open_next() {
    for (; next_ < pack_.files.size(); ++next_) {
        const PackedFile& next = pack_.files[next_];
        const fs::path file = folder_ / next.name;
        make_folder(file.parent_path());
        file_ = Fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                          S_IRUSR | S_IWUSR));
        if (file_.get() < 0) throw cannot_write(file, errno);
        sha1_.emplace();
        left_ = next.bytes;
        if (left_ > 0) return;
        end_file();
    }
}

void ReceivedScene::end_file() {
    const PackedFile& file = pack_.files[next_];
    if (sha1_digits(*sha1_) != file.sha1)
        throw std::runtime_error(
            fmt::format("'{}' changed while the scene was sent: start again", file.name));
    file_ = Fd();
}

void ReceivedScene::take(std::span<const std::byte> piece) {
    while (!piece.empty()) {
        if (!begun_ || complete())
            throw std::runtime_error("more of a scene was sent than was announced");
        const auto here = piece.first(std::min<std::uint64_t>(piece.size(), left_));
        for (std::size_t written = 0; written < here.size();) {
            const ssize_t count =
                ::write(file_.get(), here.data() + written, here.size() - written);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) throw cannot_write(folder_ / pack_.files[next_].name, errno);
            written += static_cast<std::size_t>(count);
        }
        sha1_->append(here.data(), here.size());
        left_ -= here.size();
        piece = piece.subspan(here.size());
        if (left_ > 0) return;
        end_file();
        ++next_;
        open_next();
    }
}

}  // namespace mpipov
