// Names of the stage's truths. A phase function says how air scatters, so each is held against its own integral.
#pragma once

#include <array>
#include <string_view>

namespace strata::sun_shafts {

inline constexpr std::string_view xray_phase_truth = "xray phase";

/// Mean cosines g of the angle by which light turns (Henyey, Greenstein 1941): the values of shaft_asymmetry, each with a truth.
inline constexpr std::array phase_asymmetries = {.2, .4, .6, .8};
inline constexpr std::array<std::string_view, phase_asymmetries.size()> asymmetric_truths = {
    "henyey-greenstein .2", "henyey-greenstein .4", "henyey-greenstein .6", "henyey-greenstein .8"};

}  // namespace strata::sun_shafts
