// The tone curve of a frame's film, in double. Shaders have passes/combine/hi_lo/develop.glsl.
#pragma once

#include <algorithm>

namespace strata {

/// x (1 + x / white^2) / (1 + x) of exposed radiance: 0 below 0 and 1 from white on. NaN stays.
inline double tone_mapped(double exposed, double white) {
    const double x = std::clamp(exposed, 0.0, white);
    return x * (1 + x / (white * white)) / (1 + x);
}

}  // namespace strata
