// Where the rain map lies: a parallel view along the rain, around what the eye sees up to the reach.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "passes/scene/draw_bounds.h"

namespace strata::rain {

struct RainMapShape {
    std::uint32_t size = 1024;  ///< texels a side
    double radius = 2;          ///< of lookups, in texels
    double reach = 40;          ///< meters of view depth
};

/// Of a view-space point (p, 1): texels along both axes, and depth, 1 before all casters and 0 behind them.
struct RainMap {
    glm::dvec4 u{0}, v{0}, depth{0};
    double texel = 0;            ///< meters: the same wherever the eye is and looks
    double range = 0;            ///< meters of depth from 1 to 0
    glm::dvec3 towards_rain{0};  ///< view space, unit
};

/// Along a direction of the world. Moves in steps of one texel of a grid fixed in the world.
RainMap rain_map_along(const glm::dvec3& direction, const Frame&, std::span<const BoundingSphere> casters, const RainMapShape&);
/// Along the recorded direction.
RainMap rain_map(const Frame&, std::span<const BoundingSphere> casters, const RainMapShape&);

/// Rain in a wind that turns: so many directions, evenly around the recorded one and tilted from it by `spread` radians. One is
/// the recorded one itself.
std::vector<glm::dvec3> rain_directions(const glm::dvec3& recorded, std::uint32_t count, double spread);

}  // namespace strata::rain
