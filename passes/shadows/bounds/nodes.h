// Nodes over bounds of shadow maps, level by level, for questions about many neighboring lookups at once
// (docs/algorithms/deferred.md 6.3). passes/shadows/bounds/nodes.glsl reads them.
#pragma once

#include <cstdint>
#include <span>

#include "passes/shadows/bounds/build.h"

namespace strata {

/// Levels that are built at most: with blocks of 4 texels the coarsest node is 64 texels wide.
inline constexpr std::int32_t most_bounds_levels = 4;

struct BoundsNodes {
    Image image;              ///< rg32f, layers as the bounds: levels 1, 2, .. side by side; none where there are none
    std::int32_t levels = 0;  ///< above the bounds, whose texels are level 0
};

/// Declares the steps that build the nodes over bounds of the form extremes with these settings. A node of level l holds the
/// extremes of 2^l x 2^l texels of the bounds of one map. The smallest of the maps that have bounds is at least as large as the
/// coarsest node.
BoundsNodes add_bounds_nodes(Graph&, const Image& bounds, std::span<const ShadowView>, const BoundsSettings&);

/// Fixes the constant and binds the image of passes/shadows/bounds/nodes.glsl in a step whose shader includes it.
ComputeStep& sample_bounds_nodes(ComputeStep&, const BoundsNodes&);

}  // namespace strata
