#include "passes/view_params.h"

#include <fmt/core.h>

#include "passes/technique.h"

namespace strata {
bool names_param(const DebugView& view, std::string_view param) {
    return view.help.find(fmt::format("`{}`", param)) != view.help.npos;
}

std::vector<const Param*> params_of(const Technique& technique, const DebugView& view) {
    std::vector<const Param*> found;
    for (const Param& param : technique.params)
        if (names_param(view, param.name)) found.push_back(&param);
    return found;
}

}  // namespace strata
