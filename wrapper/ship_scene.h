// Rank 0 before a run: do all hosts see the same scene, and who is sent a copy of it.
#pragma once

#include "packing.h"
#include "scene_view.h"
#include "shipped_scene.h"
#include "transport.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mpipov {

struct ShipRequest {
    Ship ship = Ship::automatic;
    SceneRequest scene;
    std::vector<std::string> arguments;  // POV-Ray's
    MayGo may_go;                        // Confinement::is_users()
    // By rank; ranks with the same view (point_of_view()) share a copy, those with rank 0's need
    // none, and "" is like no other.
    struct Rank {
        std::string host, view;
    };
    std::vector<Rank> ranks;
    double patience_seconds = 600;  // without a word of a rank that looks or unpacks
};

struct Shipping {
    ShippedScene scene;
    std::vector<std::string> hosts;  // that were sent a copy
    std::size_t files = 0;           // in it
    std::uint64_t bytes = 0;
};

// Asks one rank of each view, and sends the pack to one of each that needs it. Throws Failure: file
// where a host lacks what it is not sent, or cannot take it; interrupted after a signal or where a
// rank says nothing; std::runtime_error where a message is not what the protocol allows.
Shipping ship_scene(const ShipRequest& request, Transport& transport);

}  // namespace mpipov
