// How shadow maps are looked up: what the constants of passes/shaders/shadow_filter.glsl are fixed to.
#pragma once

#include <cstdint>

namespace strata {

/// Parameters of the shadow techniques; those that a technique does not have stay as here.
struct ShadowFilter {
    std::uint32_t kernel = 1;        ///< 0, 1, 2: 2 x 2, 4 x 4, 8 x 8 texels
    float slope_limit = 20;          ///< tangent of the steepest angle between normal and light that the bias makes up for
    std::uint32_t allocation = 0;    ///< Allocation of shadow_views.h
    std::uint32_t search_taps = 16;  ///< of soft lights: texels asked for what stands before the receiver
    std::uint32_t filter_taps = 32;  ///< of soft lights: bilinear comparisons over the penumbra
    std::uint32_t noise = 0;         ///< 1 turns the taps pixel by pixel
};

}  // namespace strata
