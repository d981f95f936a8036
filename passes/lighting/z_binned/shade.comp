// Lights whose z-bin and tile agree, on every sample that needs shading of its own (Drobot, SIGGRAPH 2017). Lanes of a subgroup walk the
// union of their lists together, so that records are read once for all; a lane adds only lights of its own list.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/edges/routing/routed.glsl"
#include "passes/gbuffer/surface_at.glsl"
#include "passes/lighting/light_term.glsl"
#include "passes/lighting/stored_light.glsl"
#include "passes/lighting/z_binned/lists.glsl"
#include "passes/shaders/finished.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 4) const uint merge = 1u;

layout(set = 0, binding = 6, scalar) buffer Counters { ZBinnedCounters counters; };

uint candidates = 0u, words_read = 0u;

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
    return near_lights(m, above, at, sum);
}

void count_shaded(bool shaded) {
    const uint here = subgroupAdd(shaded ? 1u : 0u), tried = subgroupAdd(candidates), read = subgroupAdd(words_read);
    const bool is_elected = subgroupElect();  // of those that added: after a branch they may be several groups
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
    if (!is_elected) return;
    atomicAdd(counters.samples_shaded, here);
    atomicAdd(counters.evaluations, tried);
    atomicAdd(counters.words_read, read);
}

void main() {
    const ivec3 at = place_of_thread(imageSize(light));
    if (any(greaterThanEqual(at, imageSize(light)))) return;
    const Surface s = surface_at(at);
    const bool shaded = takes_light(s);
    store_light(at, shaded ? binned_light(lit_point(s, uvec2(at.xy)), at) : vec3(0.0));
    count_shaded(shaded);
}
