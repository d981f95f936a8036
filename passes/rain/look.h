// How water looks where rain arrives: what techniques begin with and the truth keeps to.
#pragma once

#include <cstdint>
#include <string_view>

#include "passes/rain/rain.shared.h"

namespace strata::rain {

struct Look {
    std::uint32_t form = form_porosity;
    double albedo = 0.5;           ///< of a soaked porous surface, relative to its dry one
    double gloss = 0.8;            ///< 1 - roughness of a soaked porous surface
    double ripple_height = 0.002;  ///< meters
    double flow_height = 0.003;    ///< meters
    double puddles = 0.5;          ///< with the recorded wetness, how much of a level floor they cover
};

/// Of the truth that wet_form=xray approximates.
inline constexpr std::string_view xray_truth_name = "xray";
/// Of those that rain_directions above 1 approximates.
inline constexpr std::string_view wind_truth_name = "wind", xray_wind_truth_name = "xray in wind";

/// Degrees by which a turning wind tilts the rain.
inline constexpr double wind_spread = 15;

}  // namespace strata::rain
