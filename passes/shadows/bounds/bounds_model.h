// Bounds of shadow maps in double, from the chapter (docs/algorithms/deferred.md 5.4 to 5.6, reversed depth).
#pragma once

#include "passes/reference/image.h"
#include "passes/shadows/bounds/build.h"
#include "passes/shadows/kernel.h"

namespace strata::shadows {

/// All depths of a window lie between two parallel planes: least and greatest are theirs over its center.
struct Slab {
    double least = 0, greatest = 0;
    glm::dvec2 slope{0};  ///< depth per texel
    bool is_tilted() const { return slope != glm::dvec2(0); }
};

enum class Answer : std::uint32_t { lit, shadowed, expensive };

/// First texel of the block that serves a lookup.
glm::ivec2 block_begin(const Lookup&, std::uint32_t block);

/// Of the window around the block that serves a lookup. It is level in forms without slopes, where that is as close, and where
/// the window leaves the map. `width` is the distance of the tilted planes whether they are kept or not.
struct FittedSlab {
    Slab kept;
    double width = 0;
};
FittedSlab slab_of(const ReferenceImage& maps, const Lookup&, const BoundsSettings&);

/// What the bounds say of a lookup by a kernel of taps x taps texels whose receiver follows Lookup::gradient. Extremes without a
/// reach are joined over all blocks that the kernel touches.
Answer early_answer(const ReferenceImage& maps, const Lookup&, std::int64_t taps, const BoundsSettings&);

}  // namespace strata::shadows
