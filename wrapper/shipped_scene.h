// Whether a scene is sent to other hosts, and which ranks render from such a copy.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mpipov {

enum class Ship {
    automatic,  // to hosts that lack a file of the scene, or have another one of its name
    on,         // to all others
    off         // never: such hosts are refused
};

struct ShippedScene {
    std::vector<std::filesystem::path> copies = {};  // by rank; empty: sees the scene itself
    std::vector<std::string> arguments = {};         // POV-Ray's for launches in a copy
    std::string folder = {}, ini = {};  // below a copy: where POV-Ray runs, its povray.ini

    // None where the vector ends before `rank`.
    std::filesystem::path copy_for(std::size_t rank) const {
        return rank < copies.size() ? copies[rank] : std::filesystem::path();
    }
};

}  // namespace mpipov
