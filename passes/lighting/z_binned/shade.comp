// Lights whose z-bin and tile agree, on every sample that needs shading of its own (Drobot, SIGGRAPH 2017). Lanes of a subgroup walk the
// union of their lists together, so that records are read once for all; a lane adds only lights of its own list.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/gbuffer/surface.glsl"
#include "passes/gbuffer/decoders.glsl"
#include "passes/lighting/light_term.glsl"
#include "passes/lighting/z_binned/lists.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint gbuffer_layout = 0u;
layout(constant_id = 2) const uint has_edges = 0u;
layout(constant_id = 4) const uint merge = 1u;

layout(set = 0, binding = 0) uniform sampler2DArray gbuffer0;
layout(set = 0, binding = 1) uniform sampler2DArray gbuffer1;
layout(set = 0, binding = 2) uniform sampler2DArray gbuffer2;
layout(set = 0, binding = 4) uniform usampler2DArray edges;
layout(set = 0, binding = 5, rgba16f) writeonly uniform image2DArray light;
layout(set = 0, binding = 6, scalar) buffer Counters { ZBinnedCounters counters; };

const float largest_half = 65504.0;  // beyond it a half float is infinite, and infinity times nothing is not a number

uint candidates = 0u, words_read = 0u;

bool is_plain(ivec2 pixel) { return has_edges != 0u && texelFetch(edges, ivec3(pixel, 0), 0).r == 0u; }

vec3 near_lights(MaterialPoint m, vec3 above, ivec3 at, vec3 everywhere) {
    precise vec3 sum = everywhere;
    const Span span = span_of(at.xy, m.position.z);
    const bool empty = span.low > span.high;
    uint word = empty ? 0xffffffffu : span.low / 32u, last = empty ? 0u : span.high / 32u;
    if (merge == merge_subgroup) {
        word = subgroupMin(word);
        last = subgroupMax(last);
    }
    for (; word <= last && word != 0xffffffffu; ++word) {
        const uint mine = lights_in(span, word);
        uint left = merge == merge_subgroup ? subgroupOr(mine) : mine;
        ++words_read;
        candidates += bitCount(mine);
        while (left != 0u) {
            const int bit = findLSB(left);
            left &= left - 1u;
            if ((mine >> bit & 1u) != 0u) sum += light_term(sorted[word * 32u + uint(bit)].light, m, above, at);
        }
    }
    return sum;
}

vec3 binned_light(MaterialPoint m, ivec3 at) {
    const vec3 above = lifted(m);
    precise vec3 sum = vec3(0.0);
    for (uint i = 0u; i < header.everywhere; ++i) sum += light_term(sorted[i].light, m, above, at);
    candidates += header.everywhere;
    return clamp(near_lights(m, above, at, sum), -largest_half, largest_half);
}

void count_shaded(bool shaded) {
    const uint here = subgroupAdd(shaded ? 1u : 0u), tried = subgroupAdd(candidates), read = subgroupAdd(words_read);
    if (!subgroupElect()) return;
    atomicAdd(counters.samples_shaded, here);
    atomicAdd(counters.evaluations, tried);
    atomicAdd(counters.words_read, read);
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(light)))) return;
    const bool plain = is_plain(at.xy);
    if (plain && at.z > 0) return;
    const Surface s = decode_gbuffer(gbuffer_layout, texelFetch(gbuffer0, at, 0), texelFetch(gbuffer1, at, 0),
                                     texelFetch(gbuffer2, at, 0), vec2(at.xy) + 0.5);
    const bool shaded = s.exists && s.lighting_model != model_unlit;
    const vec4 radiance = vec4(shaded ? binned_light(lit_point(s, uvec2(at.xy)), at) : vec3(0.0), 1.0);
    imageStore(light, at, radiance);
    for (int sample_index = 1; plain && sample_index < imageSize(light).z; ++sample_index)
        imageStore(light, ivec3(at.xy, sample_index), radiance);
    count_shaded(shaded);
}
