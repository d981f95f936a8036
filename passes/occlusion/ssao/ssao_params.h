// Parameters of screen-space ambient occlusion.
#pragma once

#include <cstdint>

namespace strata::occlusion {

struct SsaoParams {
    std::uint32_t form;
    std::uint32_t taps;
    std::uint32_t radius;  ///< a place in passes/occlusion/radii.h
    std::uint32_t resolution;
    std::uint32_t blur;
    std::uint32_t edge_stop;
    std::uint32_t noise;
    std::uint32_t material;
    float depth_error;
    float bias;
};

}  // namespace strata::occlusion
