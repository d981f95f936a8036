// Light propagation volumes in double, as a whole.
#pragma once

#include <vector>

#include "passes/image_set.h"
#include "passes/indirect/lpv/lpv_params.h"
#include "passes/indirect/reading_model.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::indirect::in_double {

/// The volumes of a frame after propagation, and what their surfaces need to read them.
struct LitVolumes {
    std::vector<Barrier> barriers;
    std::vector<LitGrid> grids;  ///< refer to `barriers`
};
LitVolumes lit_volumes(const Frame&, const LpvParams&);

/// The image "indirect": irradiance / pi per sample; 0 where there is no surface.
ImageSet indirect_light(const StageInput&, const LpvParams&);

}  // namespace strata::indirect::in_double
