// The filter kernel in double over a shadow map (docs/algorithms/deferred.md 5.1 and 5.2, reversed depth).
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "passes/reference/image.h"

namespace strata::shadows {

/// Where a map is looked up.
struct Lookup {
    std::uint32_t layer = 0;
    std::uint32_t size = 0;  ///< texels per edge of the map, whose upper left texel is at `offset` in the layer
    glm::dvec2 u{0};         ///< texel units, centers at +.5
    double depth = 0;        ///< of the biased receiver: lit where it is at least the map's
    double doubt = 0;        ///< how far float arithmetic may have moved the depth
    glm::uvec2 offset{0};
    bool is_face = false;    ///< of a cube: beyond its edges its outermost texels go on; else nothing is drawn there
    glm::dvec2 gradient{0};  ///< what the receiver gains in depth per texel: it is compared where it is over a texel's center
    glm::dvec2 rise{0};  ///< the same, over texels alone where it is nearer to the light by more than `risen`: by what is above
    double risen = 0;    ///< depth
};

struct Filtered {
    double lit = 1;          ///< share of the kernel's weight
    bool undecided = false;  ///< a texel with weight is within `doubt` of the receiver
};

/// Depth of a texel of the map.
double map_depth(const ReferenceImage& maps, const Lookup&, glm::ivec2 texel);

/// taps x taps texels with the weights of (taps - 1)^2 bilinear taps, fractions cut to 1/256.
Filtered filter_map(const ReferenceImage& maps, const Lookup&, std::int64_t taps);

}  // namespace strata::shadows
