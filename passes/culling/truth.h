// The exact visible set: opaque and masked draws that own at least one visible sample.
#pragma once

#include "passes/image_set.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// "visible": 1 for such draws, laid out as FrameImages::visible; undecided where all samples that a draw has or may have hang on
/// rounding.
ImageSet culling_truth(const StageInput&);

}  // namespace strata
