// The stage's other truth, for settings of techniques that let light bounce twice.
#pragma once

#include <string_view>

namespace strata::indirect {

inline constexpr std::string_view two_bounces = "two bounces";

}  // namespace strata::indirect
