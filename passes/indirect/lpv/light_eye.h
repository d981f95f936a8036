// The eye that light volumes are lit by.
#pragma once

#include <span>
#include <string>

#include "capture_format/view.h"
#include "passes/scene/light_grids.h"

namespace strata::indirect {

struct LightEye {
    View view;
    std::string records;  ///< first word of the names that the scene's records are offered by as it sees them (Graph::offer)
};

/// still_view(), so that light has the same bits wherever the frame's eye is. The frame's own eye, by which light is computed
/// anew wherever that goes, in three cases: a grid is so far from the still eye that floats are coarse there; rounding decides on
/// which side of a blocker a middle is (kept/middles.h), and surfaces must read light by the decision that it was injected by;
/// the frame's axes are not unit, so that surfaces lie elsewhere than the world's. `linked`: of the grids those in which blockers
/// stop light.
LightEye light_eye(const Frame&, std::span<const LightGrid>, std::span<const LightGrid> linked);

}  // namespace strata::indirect
