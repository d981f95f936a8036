// X-Ray's depth of field in double.
#pragma once

#include "passes/reference/image.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::lens {

ReferenceImage xray_focus_model(const StageInput&, const ReferenceImage& color);

}  // namespace strata::lens
