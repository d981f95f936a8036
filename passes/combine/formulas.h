// Combining and developing a picture in double, from docs/algorithms/deferred.md 8: what truth and models compute with.
#pragma once

#include <functional>

#include "passes/reference/shade.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::combine {

/// Radiance of one sample towards the eye: emission, reflected light, light from all around, fog, sun shafts. Images that are not
/// there count as no light, no occlusion, no surface.
struct ComposedSample {
    std::uint32_t x = 0, y = 0, sample = 0;
};
/// What settings may change of a surface.
struct Look {
    /// Fog over the radiance of a surface.
    std::function<glm::dvec3(const glm::dvec3& radiance, const SurfacePoint&)> fogged;
    /// Light of sky and ground, the material's occlusion in it; none: hemisphere_light().
    std::function<glm::dvec3(const SurfacePoint&)> hemisphere = {};
};
glm::dvec3 composed(const StageInput&, const ComposedSample&, const Look&);

/// The recorded fog, exponential: the share that remains of what is at a surface, and the fog's own color.
Look recorded_look(const Frame&);

/// From radiance to exposed radiance: the recorded exposure times the factor that the lens found, where it adapts.
double exposure_of(const StageInput&);

/// Display light of a pixel: its samples exposed and tone mapped, then averaged (docs/algorithms/deferred.md 3.5).
glm::dvec3 developed(const StageInput&, const ReferenceImage& color, std::uint32_t x, std::uint32_t y);

/// Whether something is drawn over the combined color, or a lens changes it, before it is developed.
bool is_drawn_over(const Frame&);

}  // namespace strata::combine
