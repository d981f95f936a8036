// The part of a shadow map that is looked up: of surfaces in view that its light reaches.
#pragma once

#include <cstdint>
#include <optional>

#include "passes/graph/step.h"
#include "passes/scene/readers.h"
#include "passes/scene/shadow_views.h"

namespace strata {

/// Texels of a map, from its own first one.
struct MapPart {
    PixelColumns columns;
    Rows rows;
    friend bool operator==(const MapPart&, const MapPart&) = default;
};

/// The smallest rectangle around what may be looked up, to a sixteenth of the map's edge, and so many texels more on each side.
/// Nothing where no surface in view is in what the map sees. `reach`: the sphere that a local light lights, in view space; none:
/// the sun's, of which a cascade is read in its range of depth. All of the map where surfaces are anywhere (Readers).
std::optional<MapPart> read_part(const Readers&, const ShadowView&, const std::optional<BoundingSphere>& reach,
                                 std::uint32_t margin);

}  // namespace strata
