// Blending in double over whole images: what the truth and the models of transparency share.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "passes/image_set.h"
#include "passes/reference/fragments.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::transparency {

/// The new radiance of a sample: its fragments in submission order over what is behind.
using SampleBlend = std::function<glm::dvec3(std::span<const Fragment>, glm::dvec3 behind)>;

/// The same where the technique asks which sample it is (x, y, sample), and may find that its result hangs on rounding.
struct BlendedSample {
    glm::dvec3 radiance{0};
    bool undecided = false;
};
using PlacedBlend = std::function<BlendedSample(std::span<const Fragment>, glm::dvec3 behind, glm::uvec3 at)>;

/// Opaque depth per sample of `color`; nothing is in front of anything where the frame has none.
ReferenceImage opaque_depth(const ImageSet& before, const ReferenceImage& color);

/// Transparent fragments in front of a depth, lit by the light volumes that a stage found.
FragmentLists fragments_before(const Frame&, const ReferenceImage& depth, const ImageSet& before);

/// The frame's transparent fragments in front of opaque_depth(): those of StageInput::fragments, made if there are none yet, or
/// those of `own` where the input keeps none.
const FragmentLists& fragments_of(const StageInput&, const ReferenceImage& color, std::optional<FragmentLists>& own);

/// Blends the frame's transparent fragments into every sample of `color`, in front of the opaque depth before the stage. Samples
/// whose fragments are undecided become so in the image. Several threads call the blend at a time; each takes some neighboring
/// rows of pixels, from the top to the bottom, each row with all its samples.
ReferenceImage blended(ReferenceImage color, const StageInput&, const SampleBlend&);
ReferenceImage blended(ReferenceImage color, const StageInput&, const PlacedBlend&);

/// Blends object after object in painter's order, as alpha blending does: fragments of an object in the order of submission.
ReferenceImage blended_by_object(ReferenceImage color, const StageInput&, const SampleBlend&);

/// Of linear light of the primaries of BT.709, or of what is let through of it.
double luminance(glm::dvec3);

/// Scalar coverage of a fragment that may be colored: alpha (1 - mean k) = mean (1 - t) (McGuire and Mara 2016).
double coverage(const Fragment&);

/// T(z): what the fragments strictly in front of a depth let through.
glm::dvec3 transmittance_before(std::span<const Fragment>, double depth);

/// The fragments near to far; of equal depths the later submission is nearer.
std::vector<Fragment> nearest_first(std::span<const Fragment> in_submission_order);
/// The same as places in the list: fragments are large, and most callers need no copy.
std::vector<std::size_t> nearest_first_order(std::span<const Fragment> in_submission_order);

}  // namespace strata::transparency
