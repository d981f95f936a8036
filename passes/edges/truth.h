// Which pixels need every sample shaded: those whose samples do not all hold the same surface.
#pragma once

#include "passes/image_set.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// "edges": 1 where any sample's G-buffer or emission texel differs in any bit from sample 0 (docs/algorithms/deferred.md 3.2,
/// D1), where only some samples are covered, or where a layout without depth has equal words at depths that are on no plane of
/// one triangle of the frame. Empty at one sample.
ImageSet edges_truth(const StageInput&);

}  // namespace strata
