// The depths that each light reaches, in the order of the light list.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/lighting/z_binned/z_binned.shared.h"
#include "passes/shaders/light_types.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) writeonly buffer Sorted { ZLight sorted[]; };
layout(push_constant, scalar) uniform Push { ZBinsPush push; };

// Depths of the sphere around what the light reaches (docs/algorithms/lighting.md 1.4).
ZLight entry(uint i) {
    if (i >= push.lights) return ZLight(z_largest, z_largest, 0.0, i);
    const LightRecord light = lights[i];
    if (!light_has_range(light.type)) return ZLight(-z_largest, -z_largest, 0.0, i);
    float z = light.position.z, radius = light.range;
    if (light_has_round_cone(light.type)) {
        const vec2 around = sphere_around_cone(light.cos_outer, light.range);
        z += light.direction.z * around.x;
        radius = around.y * (1.0 + 1e-5) + 1e-5 * light.range;  // rounding: the window is not 0 yet there
    }
    return ZLight(z - radius, z + radius, 0.0, i);
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < push.padded) sorted[i] = entry(i);
}
