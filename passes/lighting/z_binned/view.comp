// What the bins and masks hold, per pixel or tile: how many lights, and how many of a pixel's do nothing there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/surface_at.glsl"
#include "passes/lighting/light_term.glsl"
#include "passes/lighting/z_binned/lists.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 4) const uint shown = 0u;

layout(set = 0, binding = 5, rgba32f) writeonly uniform image2D number_of_lights;

uint tile_lights(Span span) {
    uint count = header.everywhere;
    for (uint word = 0u; word < push.words; ++word) count += bitCount(masks[span.first_word + word]);
    return count;
}

bool does_nothing(uint i, MaterialPoint m, ivec3 at) {
    return light_term(sorted[i].light, m, lifted(m), at) == vec3(0.0);
}

uint pixel_lights(Span span, MaterialPoint m, ivec3 at) {
    uint count = 0u;
    for (uint i = 0u; i < header.everywhere; ++i) count += shown == view_idle_lights && !does_nothing(i, m, at) ? 0u : 1u;
    for (uint word = span.low / 32u; span.low <= span.high && word <= span.high / 32u; ++word) {
        for (uint left = lights_in(span, word); left != 0u; left &= left - 1u) {
            const uint i = word * 32u + uint(findLSB(left));
            count += shown == view_idle_lights && !does_nothing(i, m, at) ? 0u : 1u;
        }
    }
    return count;
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID.xy, 0);
    if (any(greaterThanEqual(at.xy, imageSize(number_of_lights)))) return;
    const Surface s = surface_at(at);
    float number = 0.0;
    if (s.exists) {
        const Span span = span_of(at.xy, s.z);
        number = float(shown == view_tile_lights ? tile_lights(span) : pixel_lights(span, lit_point(s, uvec2(at.xy)), at));
    }
    imageStore(number_of_lights, at.xy, vec4(vec3(number), 1.0));
}
