// Draws of a frame: meshes somewhere in the world.
#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "capture_format/frame/glm_types.h"

namespace strata {

enum class Mobility : std::uint32_t { fixed, moving };
enum class Resolution : std::uint32_t { full, low };

/// A mesh with a material somewhere in the world.
struct Draw {
    std::string name;
    std::uint32_t mesh = 0, material = 0;
    glm::dmat4 to_world{1};           ///< object to world
    glm::dmat4 previous_to_world{1};  ///< to_world of the frame before; equal to it for a draw at rest
    Mobility mobility = Mobility::fixed;
    std::int32_t sort_priority = 0;  ///< object-sorted transparency draws lower values first
    Resolution resolution = Resolution::full;
    std::uint32_t layer = 0;  ///< 0 the world; others are in-world interfaces, drawn in front in this order
    bool casts_shadow = true;
};

}  // namespace strata
