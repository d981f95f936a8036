#include "passes/edges/surface_tests.h"

#include <cmath>
#include <numbers>

#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"

namespace strata::edges {

SurfaceLimits surface_limits(double normal_angle, double depth_step, double color_step) {
    return {.least_cosine = static_cast<float>(std::cos(normal_angle * std::numbers::pi / 180)),
            .depth_step = static_cast<float>(depth_step),
            .color_step = static_cast<float>(color_step)};
}

ComputeStep test_surfaces(ComputeStep builder, const FrameImages& frame, std::uint32_t tests) {
    return sample_gbuffer(builder, frame).fixes("tests", tests);
}

}  // namespace strata::edges
