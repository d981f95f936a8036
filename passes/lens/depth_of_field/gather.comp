// Depth of field by taps (docs/algorithms/deferred.md 8.7). A tap counts by the share of its own blur's disc that it throws on this
// pixel, and belongs to one of three layers: before the pixel's surface, on it, behind it. Each layer covers those after it. What is
// behind shows where the surface does not fill the pixel: at its own blurred border.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/depth_of_field/gather.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 2, rgba32f) writeonly uniform image2DArray blurred;

struct Layers {
    vec4 before, on, behind;  // rgb and, in a, the share of the pixel that is covered
};

void add_tap(Center c, vec2 offset, inout Layers layers) {
    const Tap tap = tap_at(c, offset);
    const vec3 radiance = texelFetch(color, ivec3(tap.pixel, c.at.z), 0).rgb;
    if (!is_number(radiance)) return;
    layers.before += tap.before * vec4(radiance, 1.0);
    layers.on += tap.on * vec4(radiance, 1.0);
    layers.behind += tap.behind * vec4(radiance, 1.0);
}

Layers gathered(Center c) {
    const vec3 own = texelFetch(color, c.at, 0).rgb;
    Layers layers = Layers(vec4(0.0), is_number(own) ? vec4(own, 1.0) / disc_area(c.blur) : vec4(0.0), vec4(0.0));
    vec2 way = first_way(c.at);
    for (uint i = 0u; i < taps / 2u; ++i) {
        add_tap(c, way * (c.outer * from_center(i)), layers);
        add_tap(c, -way * (c.inner * from_center(i)), layers);
        way = next_way(way);
    }
    return layers;
}

vec3 composed(Layers layers, vec3 own) {
    const float before = min(layers.before.a, 1.0), on = min(layers.on.a, 1.0 - before);
    const float behind = layers.behind.a > 0.0 ? 1.0 - before - on : 0.0;
    const float covered = before + on + behind;
    vec3 sum = vec3(0.0);
    if (before > 0.0) sum += layers.before.rgb * (before / layers.before.a);
    if (on > 0.0) sum += layers.on.rgb * (on / layers.on.a);
    if (behind > 0.0) sum += layers.behind.rgb * (behind / layers.behind.a);
    return covered > 0.0 ? sum / covered : own;
}

vec3 seen(ivec3 at) {
    const vec3 own = texelFetch(color, at, 0).rgb;
    if (reach_at(at) <= sharp) return own;
    const Center c = center_at(at);
    const Layers layers = gathered(c);
    if (abs(c.blur) > sharp) return composed(layers, own);
    if (layers.before.a == 0.0) return own;  // in focus, and nothing before it
    return mix(own, layers.before.rgb / layers.before.a, min(layers.before.a, 1.0));
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(blurred)))) return;
    imageStore(blurred, at, vec4(seen(at), texelFetch(color, at, 0).a));
}
