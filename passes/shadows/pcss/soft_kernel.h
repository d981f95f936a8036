// The kernel of soft lights in double (docs/algorithms/lighting.md 6.1 and 6.2).
#pragma once

#include "passes/shadows/kernel.h"

namespace strata::shadows {

/// Width on the receiver of the penumbra that a source of this width makes past an edge: distances from the source, all in
/// meters. Infinitely far sources: `source` is their width per meter, and distances may count from anywhere.
double penumbra(double source, double receiver, double blocker);
double sun_penumbra(double source, double receiver, double blocker);

/// Tap i of n over the unit disc, the first one in the direction of `turn` (Vogel 1979).
glm::dvec2 disc_tap(std::int64_t i, std::int64_t n, double turn);

/// A receiver with its plane and what is known of map and light.
struct SoftLookup {
    Lookup at;
    glm::dvec2 gradient{0};     ///< of the receiver's depth per texel
    double source = 0;          ///< width: meters, of the sun per meter
    double near = 0;            ///< of a perspective map, meters: distance is near / depth; 0 of the sun's
    double depth_meters = 0;    ///< of the sun's map per unit of depth: distance is -depth times this
    double texel = 0;           ///< meters, at 1 m or anywhere
    double turn = 0;            ///< of the taps
    double texel_doubt = 2e-3;  ///< how far float arithmetic may have moved a tap
    std::int64_t search = 16, filter = 32;
};

/// Radius in texels of the disc that a blocker at this depth turns the source into: half the penumbra, between .5 and 32.
double disc_radius(const SoftLookup&, double blocker_depth);
/// 1 where no tap of the search finds anything before the receiver; else the disc's bilinear comparisons.
Filtered filter_soft(const ReferenceImage& maps, const SoftLookup&);

}  // namespace strata::shadows
