// X-Ray's depth of field in double.
#pragma once

#include "passes/stages.h"

namespace strata::lens {

ReferenceImage xray_focus_model(const StageInput&, const ReferenceImage& color);

}  // namespace strata::lens
