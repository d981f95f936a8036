// How large shadow maps are and where they lie in the layers of shadow_maps.
#pragma once

#include <span>

#include "passes/scene/shadow_views.h"

namespace strata {

/// Texels per edge of the smallest map that a light may need.
inline constexpr std::uint32_t smallest_needed_map = 32;

/// Texels per edge that a local light's map needs: one per pixel of its reach on the screen, which is the wider side of what
/// the sphere of its range projects to, rounded up to a power of two; at least smallest_needed_map, at most its own size. A light
/// that reaches to the eye's plane may be as near as anything: it keeps its own size. One wholly behind the eye needs the
/// smallest.
std::uint32_t needed_size(const Frame&, const Light&);

/// Sets layer and offset of every view: a layer each (own), or squares of powers of two packed without gaps, the largest first
/// and equals in the order given (need).
void place_maps(std::span<ShadowView>, Allocation);

/// The image that holds all places.
struct MapLayers {
    std::uint32_t extent = 0;  ///< texels per edge
    std::uint32_t layers = 0;
};
MapLayers map_layers(std::span<const ShadowView>);

}  // namespace strata
