#include "output_place.h"

#include "failure.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace mpipov {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

// A name beside `file` that nobody else uses; a reader that looks for images does not see it. What
// has not been renamed in the end is removed.
class Part {
  public:
    explicit Part(const std::filesystem::path& file)
        : part_(folder_of(file) / fmt::format(".{}.{}.part", file.filename().string(),
                                              static_cast<long>(getpid()))) {}
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;
    ~Part() {
        std::error_code ignored;
        std::filesystem::remove(part_, ignored);
    }
    const std::filesystem::path& file() const { return part_; }

  private:
    std::filesystem::path part_;
};

void check_file(const std::filesystem::path& file) {
    const std::filesystem::path folder = folder_of(file);
    if (!std::filesystem::exists(folder))
        throw Failure(Exit::file, fmt::format("cannot write '{}': no such directory '{}'",
                                              file.string(), folder.string()));
    if (std::filesystem::is_directory(file))
        throw Failure(Exit::file,
                      fmt::format("cannot write '{}': it is a directory", file.string()));
    // Access rights do not tell everything (a read-only file system, a full disk, root).
    std::string trial = (folder / ".mpipov-XXXXXX").string();
    const int descriptor = mkstemp(trial.data());
    if (descriptor < 0)
        throw Failure(Exit::file,
                      fmt::format("cannot write '{}': {}", file.string(), std::strerror(errno)));
    close(descriptor);
    unlink(trial.c_str());
}

}  // namespace

OutputPlace::OutputPlace(std::filesystem::path image, std::filesystem::path record,
                         std::filesystem::path work_folder)
    : image_(std::move(image)), record_(std::move(record)), work_folder_(std::move(work_folder)) {
    if (record_.empty()) record_ = image_.parent_path() / "run.json";
    if (work_folder_.empty()) work_folder_ = image_.string() + ".mpipov";
}

void OutputPlace::check() const {
    check_file(image_);
    check_file(record_);
}

void OutputPlace::write(const std::function<void(const std::filesystem::path&)>& encode) const {
    const Part part(image_);
    try {
        encode(part.file());
    } catch (const Failure&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw Failure(Exit::file, error.what());
    }
    std::error_code error;
    std::filesystem::rename(part.file(), image_, error);
    if (error)
        throw Failure(Exit::file,
                      fmt::format("cannot write '{}': {}", image_.string(), error.message()));
}

}  // namespace mpipov
