// Irradiance that a grid gives at a sample, over what grids after it gave: half a cell before the surface, from the eight cells around,
// without those that a blocker hides from it (docs/algorithms/lighting.md 5.8).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/edges/plain_pixels.glsl"
#include "passes/gbuffer/surface_at.glsl"
#include "passes/indirect/lpv/apply/irradiance.glsl"
#include "passes/indirect/lpv/apply/taps.glsl"
#include "passes/shaders/finished.glsl"
#include "passes/shaders/largest_half.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ApplyPush push; };

layout(set = 0, binding = 1, rgba16f) uniform image2DArray indirect;
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

void store(ivec3 at, vec3 light, float weight) {
    const vec4 after = imageLoad(indirect, at);
    const vec4 stored = vec4(min(mix(after.rgb, light, weight), largest_half), 1.0);
    imageStore(indirect, at, stored);
    if (!is_plain(at.xy)) return;
    for (int i = 1; i < imageSize(indirect).z; ++i) imageStore(indirect, ivec3(at.xy, i), stored);
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(indirect))) || at.z > 0 && is_plain(at.xy)) return;
    const Surface s = surface_at(at);
    if (!s.exists) return;
    const LitPlace lit = lit_place(s, uvec2(at.xy));
    const float inside = depth_inside(push.grid, lit.place);
    if (inside <= 0.0) {
        store(at, vec3(0.0), 0.0);
        return;
    }
    const SeenLight seen = seen_light(push.grid, lit);
    const vec3 n = lit.normal;
    const LightCell light = seen.light;
    const float scale = 1.0 / (push.grid.cell * push.grid.cell);
    store(at, scale * vec3(towards(light.red, n), towards(light.green, n), towards(light.blue, n)), min(inside / push.border, 1.0));
    atomicAdd(counters.samples, 1u);
    if (seen.hidden > 0u) atomicAdd(counters.hidden_taps, seen.hidden);
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
}
