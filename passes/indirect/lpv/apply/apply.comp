// Irradiance over pi that a grid gives at a sample, over what grids after it gave.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/edges/plain_pixels.glsl"
#include "passes/gbuffer/surface_at.glsl"
#include "passes/indirect/lpv/apply/upsampled_light.glsl"
#include "passes/shaders/finished.glsl"
#include "passes/shaders/largest_half.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ApplyPush push; };

layout(set = 0, binding = 1, rgba16f) uniform image2DArray indirect;

layout(constant_id = 6) const uint resolution = resolution_full;
layout(constant_id = 8) const uint has_lists = 0u;  // 1: tiles are those of the list for asks_taps

layout(set = 0, binding = 10, scalar) readonly buffer Dispatches { TileDispatch dispatches[]; };
layout(set = 0, binding = 11, scalar) readonly buffer Tiles { uint tiles[]; };

// Pixel and sample of the thread; beyond the picture where the list has ended.
ivec3 place_of_thread() {
    if (has_lists == 0u) return ivec3(gl_GlobalInvocationID);
    const ivec3 extent = imageSize(indirect);
    const uvec2 across = uvec2(extent.xy + 7) / 8u;
    const uint place = gl_WorkGroupID.y * tile_dispatch_width + gl_WorkGroupID.x;
    if (place >= dispatches[asks_taps].count) return extent;
    const uint tile = tiles[asks_taps * across.x * across.y + place];
    return ivec3(8u * uvec2(tile % across.x, tile / across.x) + gl_LocalInvocationID.xy, gl_WorkGroupID.z);
}

void store(ivec3 at, vec3 light, float weight) {
    const vec4 after = imageLoad(indirect, at);
    const vec4 stored = vec4(min(mix(after.rgb, light, weight), largest_half), 1.0);
    imageStore(indirect, at, stored);
    if (!is_plain(at.xy)) return;
    for (int i = 1; i < imageSize(indirect).z; ++i) imageStore(indirect, ivec3(at.xy, i), stored);
}

// Where no neighbor fits, the sample reads cells itself.
vec3 light_at(LitPlace lit, ivec2 pixel) {
    if (resolution == resolution_half) {
        const vec4 light = upsampled_light(push.grid, lit, pixel);
        if (light.a >= least_fit) return light.rgb / light.a;
        atomicAdd(counters.full_resolution_pixels, 1u);
    }
    return gathered_light(push.grid, lit);
}

void main() {
    const ivec3 at = place_of_thread();
    if (any(greaterThanEqual(at, imageSize(indirect))) || at.z > 0 && is_plain(at.xy)) return;
    const Surface s = surface_at(at);
    if (!s.exists) return;
    const LitPlace lit = lit_place(s, uvec2(at.xy));
    const float inside = depth_inside(push.grid, lit.place);
    if (inside <= 0.0) {
        store(at, vec3(0.0), 0.0);
        return;
    }
    store(at, light_at(lit, at.xy), min(inside / push.border, 1.0));
    atomicAdd(counters.samples, 1u);
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
}
