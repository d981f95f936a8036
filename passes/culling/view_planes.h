// The planes of the view's pyramid and its near plane in double, from the projection's terms: what culling models test against.
#pragma once

#include "passes/reference/bounds.h"

namespace strata {

struct View;  // capture_format/view.h

/// How far a sphere in view space reaches over that side which it reaches over least; negative: it is wholly outside.
double reach_into_view(const View&, const Sphere&);

/// What float errors of a sphere are relative to: 1 + its distance + its radius (bound_slack).
double size_with_distance(const Sphere&);

}  // namespace strata
