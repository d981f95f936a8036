// How much surfaces stop of the light between cells, in double: the geometry volume (docs/algorithms/lighting.md 5.5; Kaplanyan,
// Dachsbacher, Cascaded Light Propagation Volumes for Real-Time Indirect Illumination, I3D 2010).
//
// The chapter sums lobes of area over cell side^2 per view and takes the larger of views, so that a surface that two views see
// counts once. Here surfels have no view. Light along +axis meets the surfaces that face it, light along -axis those that face
// the other way; each is a view, and each surfel's lobe counts where it is not negative.
#pragma once

#include <span>

#include "passes/indirect/lpv/propagation/propagation_model.h"
#include "passes/indirect/lpv/surfels/surfels_model.h"

namespace strata::indirect::in_double {

/// The links, each times the share that surfels let through.
Links with_surfels(const Grid&, Links, std::span<const Surfel>);

}  // namespace strata::indirect::in_double
