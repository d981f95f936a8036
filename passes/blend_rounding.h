// Which way a device rounds sums that it blends into floats of 16, 11 and 10 bits. Vulkan leaves it open: lavapipe 22.3 rounds
// towards zero, hardware commonly to nearest. replay/measure/measured_rounding.h measures it; models of techniques that blend
// need it.
#pragma once

namespace strata {

enum class Rounding { towards_zero, to_nearest };

struct BlendRounding {
    Rounding half = Rounding::to_nearest;    ///< of r16f, rg16f and rgba16f
    Rounding packed = Rounding::to_nearest;  ///< of r11g11b10f
};

}  // namespace strata
