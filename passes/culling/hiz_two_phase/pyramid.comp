// Farthest depths: of reversed depth the least. Four levels from one, 16 x 16 texels of it to a group; the first dispatch begins
// with the pixels, of which all samples count: what is hidden must be so at every one of them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/culling/hiz_two_phase/pyramid.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint from = 0u;  // level

layout(set = 0, binding = 0) uniform sampler2DArray depth_layers;  // layer = sample
layout(set = 0, binding = 1, scalar) buffer Pyramid { float pyramid[]; };
layout(set = 0, binding = 2, scalar) buffer Counters { HizCounters counters; };

shared float least[8][8];
shared uint made;

float farthest_sample(uvec2 pixel) {
    float depth = no_depth;
    for (int s = 0; s < textureSize(depth_layers, 0).z; ++s)
        depth = min(depth, texelFetch(depth_layers, ivec3(pixel, s), 0).r);
    return depth;
}

void store(uint level, uvec2 at, float depth) {
    const uvec2 size = level_size(level);
    if (level > last_level() || any(greaterThanEqual(at, size))) return;
    pyramid[level_begin(level) + at.y * size.x + at.x] = depth;
    atomicAdd(made, 1u);
}

// A texel of level `from`; beyond its borders what changes no minimum.
float start(uvec2 at) {
    const uvec2 size = level_size(from);
    if (any(greaterThanEqual(at, size))) return no_depth;
    if (from > 0u) return pyramid[level_begin(from) + at.y * size.x + at.x];
    const float depth = farthest_sample(at);
    store(0u, at, depth);
    return depth;
}

void main() {
    const uvec2 own = gl_LocalInvocationID.xy;
    if (gl_LocalInvocationIndex == 0u) made = 0u;
    barrier();
    const uvec2 fine = 2u * gl_GlobalInvocationID.xy;
    const vec4 four = vec4(start(fine), start(fine + uvec2(1u, 0u)), start(fine + uvec2(0u, 1u)), start(fine + 1u));
    least[own.y][own.x] = min(min(four.x, four.y), min(four.z, four.w));
    store(from + 1u, gl_GlobalInvocationID.xy, least[own.y][own.x]);
    for (uint step = 1u; step < levels_per_dispatch; ++step) {  // a thread for each texel that is left, in the upper left corner
        barrier();
        const uint side = 8u >> step;
        const uvec2 at = 2u * min(own, uvec2(side - 1u));
        const float depth =
            min(min(least[at.y][at.x], least[at.y][at.x + 1u]), min(least[at.y + 1u][at.x], least[at.y + 1u][at.x + 1u]));
        barrier();
        if (any(greaterThanEqual(own, uvec2(side)))) continue;
        least[own.y][own.x] = depth;
        store(from + 1u + step, gl_WorkGroupID.xy * side + own, depth);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u) atomicAdd(counters.pyramid_texels, made);
}
