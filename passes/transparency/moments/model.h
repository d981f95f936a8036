// The technique in double precision, from the paper and not from the shader: weights of the canonical representation by a linear
// system, roots between the extrema of the polynomial, instead of closed forms.
#pragma once

#include <span>

#include "passes/transparency/functions/model.h"
#include "passes/transparency/moments/moments_params.h"

namespace strata {

class Settings;  // passes/settings.h

}  // namespace strata

namespace strata::transparency {

/// b0 and the normalized, biased b1, b2, ... of power moments; or cos, sin, cos, sin, ... of trigonometric ones.
/// Share of the absorbance in front of w in [-1, 1], `overestimation` of what is at w included.
double absorbance_share(std::uint32_t kind, std::span<const double> moments, double w, double overestimation);

/// What 16 bits make of normalized moments, and back.
std::vector<double> quantized(std::uint32_t kind, std::span<const double> moments);
std::vector<double> dequantized(std::uint32_t kind, std::span<const double> stored);

/// T(w) of optical depths at warped depths, through the whole technique at full precision or as stored: half floats to nearest.
struct WarpedFragment {
    double w = 0, optical_depth = 0;
};
double transmittance_in_double(const MomentsParams&, std::span<const WarpedFragment>, double w, double own_optical_depth = 0);

ImageSet moments_model(const StageInput&, const Settings&);

}  // namespace strata::transparency
