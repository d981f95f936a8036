// A technique's parameter as a widget: wherever one is set, it looks and is clicked the same.
#pragma once

#include "ui/widgets/widgets.h"

namespace strata {

struct Param;  // passes/settings.h

}  // namespace strata

namespace strata::ui {

/// "value": a list of its choices or a slider over its range. The new value where a hand changed it.
std::optional<double> draw_value(Widgets&, const Param&, double value);

}  // namespace strata::ui
