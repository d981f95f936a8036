// Parameters of the tolerant comparison.
#pragma once

#include <cstdint>

namespace strata::edges {

struct TolerantParams {
    float normal_angle;
    float depth_step;
    float color_step;
};

}  // namespace strata::edges
