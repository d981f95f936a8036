// The tiles of one mode: every pixel adds up its tile's lights in index order, which is the order of a loop over all lights, so
// that the picture is that loop's bit by bit. `mode_features` folds away what the mode's tiles do not need.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/gbuffer/surface_at.glsl"
#include "passes/lighting/light_arrives.glsl"
#include "passes/lighting/stored_light.glsl"
#include "passes/lighting/tiled/tiled.shared.h"
#include "passes/shaders/finished.glsl"

layout(local_size_x = 256) in;
layout(constant_id = 82) const uint has_shadows = 0u;
layout(constant_id = 83) const uint shadow_source = shadows_image;
layout(constant_id = 84) const uint branches = branches_specialized;
layout(constant_id = 85) const uint mode = 0u;
layout(constant_id = 86) const uint mode_features = every_light_feature;
layout(constant_id = 87) const uint asks_blockers = 1u;  // of lights without a list

layout(set = 0, binding = 3) uniform sampler2DArray visibility;
layout(set = 0, binding = 4) uniform sampler2DArray shadow_maps;
layout(set = 0, binding = 7, scalar) readonly buffer Records { TileRecord records[]; };
layout(set = 0, binding = 8, scalar) readonly buffer Tiles { uint tiles[]; };
layout(set = 0, binding = 9, scalar) readonly buffer Dispatches { ModeDispatch dispatches[]; };
layout(set = 0, binding = 10, scalar) buffer Counters { TiledCounters counters; };

#include "passes/shaders/shadow_filter.glsl"
#include "passes/shaders/plain_kernel.glsl"
#include "passes/lighting/tiled/tile_lights.glsl"

// 8 x 8 pixels in a row of threads: a wave of 64 is a block, which depth and shadows suit better than rows
// (docs/algorithms/lighting.md 1.8).
uvec2 lane_pixel() {
    const uint thread = gl_LocalInvocationIndex, block = thread / 64u;
    return 8u * uvec2(block & 1u, block / 2u) + uvec2(thread & 7u, thread / 8u & 7u);
}

void shade_sample(uint tile, ivec3 at, inout Shaded shaded) {
    const Surface s = surface_at(at);
    vec3 radiance = vec3(0.0);
    if (takes_light(s)) {
        radiance = lights_of_tile(tile, lit_point(s, uvec2(at.xy)), at, shaded);
        ++shaded.samples;
    }
    store_light(at, radiance);
}

void count(Shaded shaded) {
    const uvec3 all = subgroupAdd(uvec3(shaded.samples, shaded.evaluations, shaded.blocker_tests));
    const bool is_elected = subgroupElect();  // of those that added: after a branch they may be several groups
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
    if (!is_elected) return;
    atomicAdd(counters.samples_shaded, all.x);
    atomicAdd(counters.evaluations, all.y);
    atomicAdd(counters.blocker_tests, all.z);
}

void main() {
    const uint place = gl_WorkGroupID.y * dispatch_width + gl_WorkGroupID.x;
    if (place >= dispatches[mode].count) return;
    const uint tile = tiles[dispatches[mode].first + place];
    const uint across = (view.extent.x + tile_size - 1u) / tile_size;
    const ivec2 pixel = ivec2(uvec2(tile % across, tile / across) * tile_size + lane_pixel());
    if (any(greaterThanEqual(pixel, imageSize(light).xy))) return;
    Shaded shaded = Shaded(0u, 0u, 0u);
    const int samples = is_plain(pixel) ? 1 : imageSize(light).z;
    for (int i = 0; i < samples; ++i) shade_sample(tile, ivec3(pixel, i), shaded);
    count(shaded);
}
