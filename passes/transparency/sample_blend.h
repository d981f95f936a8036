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

/// The same for methods to which it matters where the sample is.
struct Place {
    std::uint32_t x = 0, y = 0, sample = 0;
};
using PlacedBlend = std::function<glm::dvec3(std::span<const Fragment>, glm::dvec3 behind, Place)>;

/// Blends the frame's transparent fragments into every sample of `color`, in front of the opaque depth of `before`. Samples
/// whose fragments are undecided become so in the image.
ReferenceImage blended(ReferenceImage color, const Frame&, const ImageSet& before, const SampleBlend&);
ReferenceImage blended(ReferenceImage color, const Frame&, const ImageSet& before, const PlacedBlend&);

/// The fragments near to far; of equal depths the later submission is nearer.
std::vector<Fragment> nearest_first(std::span<const Fragment> in_submission_order);

}  // namespace strata::transparency
