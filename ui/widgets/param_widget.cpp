#include "ui/widgets/param_widget.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include "passes/settings.h"

namespace strata::ui {

std::optional<double> draw_value(Widgets& widgets, const Param& param, double value) {
    std::optional<double> set;
    if (!param.choices.empty()) {
        const auto chosen = widgets.combo("value", param.choices, static_cast<std::size_t>(value));
        if (chosen) set = static_cast<double>(*chosen);
    } else {
        set = widgets.slider("value", value,
                             {.low = param.low,
                              .high = param.high,
                              .logarithmic = param.scale == Scale::logarithmic,
                              .whole = param.scalar == Scalar::integer,
                              .format = "%.4g"});
    }
    widgets.help(fmt::format("{}\nCtrl+click types a number", param.help));
    return set;
}

}  // namespace strata::ui
