#include "output_place.h"

#include "failure.h"
#include "part_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <climits>
#include <stdexcept>
#include <system_error>

namespace mpipov {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

void check_file(const std::filesystem::path& file) {
    const std::filesystem::path folder = folder_of(file);
    std::error_code error;
    const bool there = std::filesystem::exists(file, error);
    if (error.value() == ENAMETOOLONG)
        throw Failure(Exit::file,
                      fmt::format("cannot write '{}': {}", file.string(), error.message()));
    if (!std::filesystem::exists(folder))
        throw Failure(Exit::file, fmt::format("cannot write '{}': no such directory '{}'",
                                              file.string(), folder.string()));
    if (there && std::filesystem::is_directory(file))
        throw Failure(Exit::file,
                      fmt::format("cannot write '{}': it is a directory", file.string()));
    // Access rights do not tell everything (a read-only file system, a full disk, root).
    const PartFile trial(file);
}

// A name may have 255 bytes.
std::filesystem::path work_folder_beside(const std::filesystem::path& image) {
    constexpr std::size_t longest = NAME_MAX;
    const std::string ending = ".mpipov";
    const std::string name = image.filename().string();
    return image.parent_path() / (name.substr(0, longest - ending.size()) + ending);
}

}  // namespace

OutputPlace::OutputPlace(std::filesystem::path image, std::filesystem::path record,
                         std::filesystem::path work_folder)
    : image_(std::move(image)), record_(std::move(record)), work_folder_(std::move(work_folder)) {
    // Not in /dev beside a device.
    const std::filesystem::path beside = is_written_into(image_) ? image_.filename() : image_;
    if (record_.empty()) record_ = beside.parent_path() / "run.json";
    if (work_folder_.empty()) work_folder_ = work_folder_beside(beside);
}

void OutputPlace::check() const {
    check_file(image_);
    check_file(record_);
}

void OutputPlace::write(const std::function<void(const std::filesystem::path&)>& encode) const {
    try {
        PartFile part(image_);
        encode(part.path());
        part.take_place();
    } catch (const Failure&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw Failure(Exit::file, error.what());
    }
}

}  // namespace mpipov
