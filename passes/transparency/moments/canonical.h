// The canonical representation of a sequence of moments with one node pinned: the few point masses that have these moments.
// In double, for the model.
#pragma once

#include <span>

namespace strata::transparency {

/// Mass in front of w of the measure with the power moments 1, b1, b2, ... on the real line; `at_node` of what is at w counts.
double power_share(std::span<const double> moments, double w, double at_node);

/// The same on the unit circle from cos and sin of the multiples of the phase; mass beyond `zone_begins` counts, too, more so
/// towards 2 pi (Muenstermann et al. 2018, postscript).
double circle_share(std::span<const double> moments, double phase, double zone_begins, double at_node);

}  // namespace strata::transparency
