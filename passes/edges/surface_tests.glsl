// Whether the surfaces of a pixel's samples are different enough to be shaded one by one (docs/algorithms/deferred.md 3.2, D2).
// passes/edges/surface_tests.h binds what is read.
#ifndef PASSES_EDGES_SURFACE_TESTS_GLSL
#define PASSES_EDGES_SURFACE_TESTS_GLSL
#include "passes/edges/mark.glsl"
#include "passes/gbuffer/surface_at.glsl"

layout(constant_id = 1) const uint tests = 0u;  // bits: test_*

float sum_of(vec3 v) { return v.x + v.y + v.z; }

// What an eye sees of a material without any light: its color and its own light.
bool materials_differ(Surface a, Surface b, vec3 light_a, vec3 light_b, float step) {
    return a.lighting_model != b.lighting_model || a.metallic != b.metallic ||
           sum_of(abs(a.base_color - b.base_color)) + sum_of(abs(light_a - light_b)) > step;
}

// Of sample i and sample 0, which both have a surface.
bool surfaces_differ(ivec2 pixel, int i, SurfaceLimits limits) {
    const Surface a = surface_at(ivec3(pixel, 0)), b = surface_at(ivec3(pixel, i));
    if ((tests & test_normal) != 0u && dot(a.normal, b.normal) < limits.least_cosine) return true;
    if ((tests & test_depth) != 0u && abs(a.z - b.z) > limits.depth_step * min(a.z, b.z)) return true;
    if ((tests & test_material) == 0u) return false;
    return materials_differ(a, b, texelFetch(emission, ivec3(pixel, 0), 0).rgb, texelFetch(emission, ivec3(pixel, i), 0).rgb,
                            limits.color_step);
}

// Of a pixel whose samples all have a surface.
bool any_surface_differs(ivec2 pixel, SurfaceLimits limits) {
    if (tests == 0u) return false;
    for (int i = 1; i < sample_count(); ++i)
        if (surfaces_differ(pixel, i, limits)) return true;
    return false;
}

#endif
