// Casters drawn into a shadow map, in double: triangles are met by the ray of each texel's middle.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "passes/reference/image.h"

namespace strata {

struct Frame;  // capture_format/frame.h

}  // namespace strata

namespace strata::shadows {

/// A map and its place in its layer.
struct CasterMap {
    glm::dmat4 view_to_map{1};  ///< (u, v, depth, w) of (view-space position, 1): uv 0..1 of the map, depth 1 at the light, 0 far
    std::uint32_t size = 0;     ///< texels per edge
    glm::uvec2 offset{0};       ///< of its upper left texel: dithers count texels of the layer
};

/// size x size texels: in x the depth of the nearest caster, 0 where there is none, in y how far the device's may be from it.
/// `mask` is a mode of passes/gbuffer/coverage/coverage.shared.h. Undecided: a triangle's side
/// within 1.5/256 texel, over which snapped positions may move the middle, and an alpha that a float may put on the other side of
/// its cutoff.
ReferenceImage cast_model(const Frame&, const CasterMap&, std::uint32_t mask);

}  // namespace strata::shadows
