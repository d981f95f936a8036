// Wet surfaces in double, from docs/algorithms/deferred.md 7.4 to 7.7: what truth, judge and models compute with.
#pragma once

#include "passes/rain/look.h"
#include "passes/reference/shade.h"

namespace strata::rain {

/// Share of the rain that a surface catches by its slope; `up` is the cosine between its normal and where rain comes from.
double slope_weight(double up);
/// The cosine, for a view-space normal.
double cosine_to_rain(const Frame&, const glm::dvec3& normal);

/// How much of the patterns a picture shows: 1 but where a pixel is wider than they are.
struct Shown {
    double rings = 1, streams = 1;
};

/// The surface with water on it; `arriving` is the share of rain that nothing keeps away. Unlit surfaces stay as they are.
SurfacePoint wet_surface(const Frame&, const SurfacePoint& dry, const Look&, double arriving, const Shown& = {});

/// Change of the water's height along x and z of the world at a world position, where rings are (per meter).
glm::dvec2 ring_gradient(const Frame&, const glm::dvec3& world, double height);
/// 1 in a puddle, 0 outside, for wetness times puddles.
double puddle_at(const glm::dvec3& world, double amount);
/// Whether the speed of streams hangs on rounding: a step begins within 1e-4 of this cosine.
bool is_between_flow_steps(double up);

/// World position of a view-space one.
glm::dvec3 to_world(const Frame&, const glm::dvec3& position);

}  // namespace strata::rain
