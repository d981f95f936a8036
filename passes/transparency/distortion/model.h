// Distortion of the background in double: see bent_background.h.
#pragma once

#include "passes/transparency/sample_blend.h"

namespace strata::transparency {

/// What is behind a sample (x, y, sample), `offset` away in uv: bilinear, edges held.
BlendedSample seen_behind(const ReferenceImage& behind, glm::uvec3 at, glm::dvec2 offset);

/// What a technique blends over that calls distort_background(): `color` before the stage, bent by object.
ReferenceImage background(const StageInput&);

}  // namespace strata::transparency
