// A scene that was sent to this rank, as files below a folder of our own.
#pragma once

#include "fd.h"
#include "scene_pack.h"

#include <OpenImageIO/hash.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace mpipov {

class ReceivedScene {
  public:
    // `folder` is made; it must not be there. Throws std::runtime_error where the pack is refused,
    // Failure(Exit::file) where the files cannot be made or there is no space for them.
    void begin(const std::filesystem::path& folder, ScenePack pack, const PackLimits& limits = {});
    // The next bytes of the pack's files, one after the other; an end of a file need not be that of
    // a piece. Throws as begin() does, also where they are others than were announced.
    void take(std::span<const std::byte> piece);

    // All files are there.
    bool complete() const { return begun_ && next_ == pack_.files.size(); }
    const std::filesystem::path& folder() const { return folder_; }

  private:
    void open_next();
    void end_file();

    std::filesystem::path folder_;
    ScenePack pack_;
    bool begun_ = false;
    std::size_t next_ = 0;    // the file that bytes are for
    std::uint64_t left_ = 0;  // bytes of it
    Fd file_;
    std::optional<OIIO::SHA1> sha1_;
};

}  // namespace mpipov
