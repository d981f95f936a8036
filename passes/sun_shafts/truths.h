// Names of the stage's truths. A phase function says how air scatters, so each is held against its own integral.
#pragma once

#include <string_view>

namespace strata::sun_shafts {

inline constexpr std::string_view xray_phase_truth = "xray phase";

}  // namespace strata::sun_shafts
