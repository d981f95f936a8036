// Tests of two samples' surfaces against limits: their parameters, and what their shaders are given.
#pragma once

#include "passes/edges/edges.shared.h"
#include "passes/edges/mark.h"

namespace strata::edges {

// The start values of docs/algorithms/deferred.md 3.2.
inline constexpr Param normal_angle_row = {
    .name = "normal_angle",
    .low = 0.1,
    .high = 90,
    .fallback = 8,
    .help = "angle between normals, in degrees, above which samples are shaded one by one"};
inline constexpr Param depth_step_row = {
    .name = "depth_step",
    .low = 1e-4,
    .high = 1,
    .fallback = 0.01,
    .help = "difference of view depth, relative to it, above which samples are shaded one by one",
    .scale = Scale::logarithmic};
inline constexpr Param color_step_row = {.name = "color_step",
                                         .low = 0.001,
                                         .high = 3,
                                         .fallback = 0.1,
                                         .help =
                                             "difference of base color and emission, summed over red, green and blue, "
                                             "above which samples are shaded one by one",
                                         .scale = Scale::logarithmic};

/// Help of parameters that add these tests to a technique's own.
inline constexpr std::string_view added_tests_help =
    "tests of a pixel's decoded surfaces beside this one; a pixel that fails any of them is marked";

/// Limits as shaders take them; techniques without one of them give its start value.
SurfaceLimits surface_limits(double normal_angle, double depth_step, double color_step);

/// Binds the G-buffer and fixes which tests (bits test_*) a shader makes that includes passes/edges/surface_tests.glsl.
ComputeStep test_surfaces(ComputeStep, const FrameImages&, std::uint32_t tests);

}  // namespace strata::edges
