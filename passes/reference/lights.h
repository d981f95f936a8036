// What surfaces reflect of lights, in double: as it is done in real time, and as it is. Written from
// docs/algorithms/lighting.md 0.3 and 0.4 and not from the shaders.
#pragma once

#include <cstdint>
#include <functional>

#include <glm/glm.hpp>

#include "passes/reference/shade.h"

namespace strata {

/// Meters: the inverse square law ends here (docs/algorithms/lighting.md 0.3, e).
inline constexpr double nearest_light = 0.01;

/// Radiance towards the eye at the origin from one light without shadow and blockers, by the techniques of
/// passes/shaders/lights.glsl: points exactly (pictures filtered over the pixel's footprint), areas by Lambert's polygons (round
/// ones have 16 corners) and linearly transformed cosines, what Burley adds to Lambert, and all of cloth, skin and hair, as
/// from the emitter's mean direction.
glm::dvec3 reflected(const Frame&, const SurfacePoint&, const Light&);

struct ExactOptions {
    /// Share of the light that arrives from a point of the emitter, view space, homogeneous: (direction towards it, 0) if
    /// directional. Everything, if empty.
    std::function<double(const glm::dvec4&)> visible;
    double tolerance = 1e-4;      ///< of the integral over an emitter, relative; an estimate from above
    std::uint32_t most = 20'000;  ///< evaluations of the integrand, after which it is taken as it is
};

/// The same as what it approximates: the BRDF integrated over the emitter, its picture unfiltered. Points are as in real time.
glm::dvec3 exact_reflected(const Frame&, const SurfacePoint&, const Light&, const ExactOptions& = {});

/// 1 at a distance of 0 from the light, 0 from the range on.
double range_window(const Light&, double distance);

/// How much of a square spot is left at s half widths from its axis: 1 until the feather begins, 0 from the edge on. Without a
/// feather everything up to the edge is lit.
double square_edge(double s, double feather);

/// Place in the picture that a spot throws, +-1 at its edges, of a direction in the axes (u, v, along) of the light with
/// along > 0; any length.
glm::dvec2 place_in_spot(const Light&, const glm::dvec3& away);

/// Share of a square spot's light at such a place, its picture left out: 1 within, 0 beyond the edges.
double square_spot_share(const glm::dvec2& place);

/// The same of a round spot, by the cosine of the angle from its axis.
double round_spot_share(const Light&, double cosine);

}  // namespace strata
