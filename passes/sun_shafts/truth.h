// The truth of sun shafts: single scattering by homogeneous air between the eye and the surface, in double.
//
//     L = E phase(angle) * integral from 0 to D of V(t) sigma exp(-sigma t) dt
//
// E: the sun's irradiance; sigma: the fog's density, all of which scatters; D: meters along the ray to the surface, or to the
// view depth sun.shadow_distance if nothing is nearer; V(t): 0 where a caster stands between the place at t and the sun, else 1.
// The sun is a point: its angular radius is left out. Between the ends of V's intervals, found exactly, the integral has a closed
// form.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// "shafts": radiance, one layer per sample, each along its own ray. Isotropic: phase = 1 / (4 pi).
ImageSet sun_shafts_truth(const StageInput&);
/// With the phase of X-Ray: (.8 (.5 c + .5) + .2) / (4 pi), c the cosine between the view's axis and the way to the sun. With
/// that of Henyey and Greenstein 1941: (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^1.5), cos of the angle between the ray and the way
/// to the sun.
std::vector<TruthRow> other_sun_shafts_truths();

}  // namespace strata
