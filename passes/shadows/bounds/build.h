// Bounds of shadow maps: for every block of texels how near to the light and how far from it they are, so that a lookup whose
// receiver lies before or behind all of them needs no comparison (docs/algorithms/deferred.md 5.3 to 5.6). Any stage may build
// them; passes/shadows/bounds/query.glsl reads them.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "passes/graph/step.h"
#include "passes/scene/shadow_views.h"

namespace strata {

class ComputeStep;  // passes/graph/graph.h
class Graph;        // passes/graph/graph.h

/// What a texel of the bounds says of the map texels in its window. Depth is 1 at the light and 0 where nothing is drawn.
enum class BoundsForm : std::uint32_t {
    extremes,  ///< rg32f: the least and the greatest depth
    levels,    ///< the same of blocks of 2, 4, .. `block` texels, each level made from 2 x 2 texels of the one below; no reach
    slabs,     ///< rgba32f: two parallel planes between which all depths lie; level ones at the map's edges
    planes,    ///< the same where they are closer than plane_tolerance, else the least and the greatest depth
};

struct BoundsSettings {
    BoundsForm form = BoundsForm::extremes;
    std::uint32_t block = 4;  ///< 2, 4 or 8 texels per edge
    /// Texels beyond each edge of the block that its window covers, so K = block + 2 reach. One texel of the bounds answers every
    /// lookup at u that weights no texel farther than this from floor(u): N / 2 for the kernel of N texels, 0 for a single texel,
    /// ceil(r + 1/2) for a bilinear tap displaced by up to r texels.
    std::uint32_t reach = 2;

    std::uint32_t window() const { return block + 2 * reach; }
};

/// Distance in map depth of the planes of a slab that BoundsForm::planes takes for one plane: 1e-4 as in X-Ray
/// (docs/algorithms/deferred.md 5.6).
inline constexpr float plane_tolerance = 1e-4f;

/// Declares the steps that build the bounds of the maps of these views: all views of a light, or none. Layers are those of
/// shadow_maps; block (x, y) of a map lies at offset / block + (x, y), so neighbors in a layer stay apart. Where no map lies the
/// bounds are 0. Maps smaller than a block get none, and query.glsl answers "expensive" for them. Beyond a map's edge depth is 0,
/// beyond the edge of a cube's face its outermost texels go on: as lookups read it.
Image add_shadow_bounds(Graph&, const Image& shadow_maps, std::span<const ShadowView>, const BoundsSettings&);

/// The name of the image that holds bounds with these settings.
std::string bounds_name(const BoundsSettings&);
/// Whether the image holds bounds with these settings: by its name, since the steps that built it are gone where a session kept
/// it.
bool are_bounds(const Graph&, const Image&, const BoundsSettings&);

/// Fixes the constants of passes/shadows/bounds/query.glsl in a step whose shader includes it. The step also says
/// .samples("shadow_bounds", ...).
ComputeStep& fix_shadow_bounds(ComputeStep&, const BoundsSettings&);

}  // namespace strata
