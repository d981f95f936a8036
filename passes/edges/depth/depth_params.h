// Parameters of the depth test.
#pragma once

#include <cstdint>

namespace strata::edges {

struct DepthParams {
    std::uint32_t paired_with;
    float residual;
    float normal_angle;
    float color_step;
};

}  // namespace strata::edges
