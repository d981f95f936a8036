// The technique on whole images: columns of a prepass (volume/column.h), filtered and read by every fragment.
#pragma once

#include "passes/image_set.h"
#include "passes/transparency/voxel/voxel.shared.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::transparency {

/// What stochastic rounding adds to a code, of a fragment's texel, draw and triangle: from 0 to 1.
double random_rounding(glm::uvec2 texel, std::uint32_t draw, std::uint32_t triangle);

ImageSet voxel_model(const StageInput&, const Settings&);

}  // namespace strata::transparency
