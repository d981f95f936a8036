// Blending in double over whole images: what the truth and the models of transparency share.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "passes/reference/fragments.h"
#include "passes/stages.h"

namespace strata::transparency {

/// The new radiance of a sample: its fragments in submission order over what is behind.
using SampleBlend = std::function<glm::dvec3(std::span<const Fragment>, glm::dvec3 behind)>;

/// Whether a sample hangs on rounding for a reason of the method's own: a code that two depths share or do not.
using SampleDoubt = std::function<bool(std::span<const Fragment>)>;

/// Blends the frame's transparent fragments into every sample of `color`, in front of the opaque depth of `before`. Samples
/// whose fragments are undecided, or doubtful, become so in the image.
ReferenceImage blended(ReferenceImage color, const Frame&, const ImageSet& before, const SampleBlend&,
                       const SampleDoubt& doubtful = {});

/// The fragments near to far; of equal depths the later submission is nearer.
std::vector<Fragment> nearest_first(std::span<const Fragment> in_submission_order);

}  // namespace strata::transparency
