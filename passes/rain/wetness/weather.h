// The recorded weather as the shader is told of it: near the eye and near the present, so that floats are fine.
#pragma once

#include "passes/rain/wetness/rain_map.h"
#include "passes/rain/wetness/wetness.shared.h"
#include "passes/rain/wetness/wetness_params.h"

namespace strata::rain {

/// Turns since time 0: whole ones modulo 2^32, and the rest.
struct Turns {
    std::uint32_t whole = 0;
    float rest = 0;
};
Turns turns_of(double time, double rate);

RainRecord record_of(const RainMap&, const WetnessParams&);
/// With the map of the only direction, or of the first. Slopes are told to the recorded direction, whichever the map's is.
WetnessPush weather_push(const Frame&, const RainMap&, const WetnessParams&);

}  // namespace strata::rain
