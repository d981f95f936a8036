// What every transparency technique approximates: all fragments of a sample, sorted by depth and blended, in double.
#pragma once

#include <span>

#include "passes/image_set.h"
#include "passes/reference/fragments.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// One sample's fragments in submission order over what is behind: C = sum T (p + e) + T_total L_behind, near to far. Of equal
/// depths the later submission is nearer.
glm::dvec3 exact_blend(std::span<const Fragment>, glm::dvec3 behind);
/// The same where their nearest_first_order() is known.
glm::dvec3 exact_blend(std::span<const Fragment>, std::span<const std::size_t> nearest_first, glm::dvec3 behind);

/// How far from a sample, in uv, what is behind its fragments is seen: sum T d (docs/algorithms/transparency.md 6.13).
glm::dvec2 exact_distortion(std::span<const Fragment>);

/// Least and largest radiance of a sample, channel by channel, over all that rounding may make of its fragments: which of those
/// at a side or at the opaque depth are there, and the orders of those whose depths a float cannot tell apart; of more than five
/// such in a row, the orders that swap two neighbors.
struct RadianceInterval {
    glm::dvec3 low{0}, high{0};
};
RadianceInterval blend_interval(std::span<const Fragment>, std::span<const NearMiss>, glm::dvec3 behind);

/// `color` as it should be after transparency, per sample (docs/algorithms/transparency.md 1); undecided samples have both ends
/// of their interval as alternatives, unless what is behind them may be seen anywhere.
ImageSet transparency_truth(const StageInput&);

}  // namespace strata
