// Depth of field by taps (docs/algorithms/deferred.md 8.7). Half of the taps fill the disc of the largest blur that reaches the pixel,
// half that of the pixel's own. A tap counts by the share of its own blur's disc that it throws on this pixel, and belongs to one of
// three layers: before the pixel's surface, on it, behind it. Each layer covers those after it. What is behind shows where the surface
// does not fill the pixel: at its own blurred border.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/depth_of_field/blur.glsl"
#include "passes/shaders/hash.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const uint taps = 64u;

layout(set = 0, binding = 1) uniform sampler2D spread;
layout(set = 0, binding = 2, rgba32f) writeonly uniform image2DArray blurred;

const float pi = 3.14159265;
const float sharp = 0.5;                                      // pixels: a disc that is no wider than its pixel
const vec2 golden = vec2(-0.737368878078320, 0.675490294261524);  // cosine and sine of pi (3 - sqrt(5))

struct Layers {
    vec4 before, on, behind;  // rgb and, in a, the share of the pixel that is covered
};

struct Center {
    ivec3 at;
    float blur, outer, inner;  // pixels: own blur, radii of the two discs of taps
};

// Pixels of the picture that a tap stands for, by how densely both discs together lie around it.
float area(Center c, float away) {
    const float inside_inner = clamp(c.inner - away + 0.5, 0.0, 1.0);
    return pi / (0.5 * float(taps) * (1.0 / (c.outer * c.outer) + inside_inner / (c.inner * c.inner)));
}

float disc_area(float blur) { return max(1.0, pi * blur * blur); }

void add_tap(Center c, vec2 offset, inout Layers layers) {
    const ivec2 pixel = clamp(ivec2(floor(vec2(c.at.xy) + 0.5 + offset)), ivec2(0), textureSize(color, 0).xy - 1);
    const ivec2 apart = pixel - c.at.xy;
    const vec3 radiance = texelFetch(color, ivec3(pixel, c.at.z), 0).rgb;
    if (apart == ivec2(0) || !is_number(radiance)) return;
    const float away = length(vec2(apart)), blur = blur_at(ivec3(pixel, c.at.z)), deeper = blur - c.blur;
    const float before = clamp(-deeper, 0.0, 1.0), behind = clamp(deeper, 0.0, 1.0);
    const float pixels = area(c, away);
    const float thrown = pixels * clamp(abs(blur) - away + 0.5, 0.0, 1.0) / disc_area(blur);
    layers.before += before * thrown * vec4(radiance, 1.0);
    layers.on += (1.0 - before - behind) * thrown * vec4(radiance, 1.0);
    // What is nearest to the surface's border stands for what it hides.
    const float near_by = pixels * clamp(c.inner - away + 0.5, 0.0, 1.0) / (away * away);
    layers.behind += behind * near_by * vec4(radiance, 1.0);
}

Layers gathered(Center c) {
    const vec3 own = texelFetch(color, c.at, 0).rgb;
    Layers layers = Layers(vec4(0.0), is_number(own) ? vec4(own, 1.0) / disc_area(c.blur) : vec4(0.0), vec4(0.0));
    // A first way by arithmetic alone: a driver's sine could put a tap into another pixel.
    const float t = float(hashed(view.seed, uvec3(c.at.xy, 0u)) >> 16u) / 32768.0 - 1.0;
    vec2 way = vec2(1.0 - t * t, 2.0 * t) / (1.0 + t * t);
    for (uint i = 0u; i < taps / 2u; ++i) {
        const float from_center = sqrt((float(i) + 0.5) / (0.5 * float(taps)));
        add_tap(c, way * (c.outer * from_center), layers);
        add_tap(c, -way * (c.inner * from_center), layers);
        way = vec2(way.x * golden.x - way.y * golden.y, way.x * golden.y + way.y * golden.x);
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
    const float blur = blur_at(at), reach = texelFetch(spread, at.xy / int(blur_tile), 0).r;
    if (reach <= sharp) return own;
    const float outer = reach + 0.5;
    Layers layers = gathered(Center(at, blur, outer, min(abs(blur) + 0.5, outer)));
    if (abs(blur) > sharp) return composed(layers, own);
    if (layers.before.a == 0.0) return own;  // in focus, and nothing before it
    return mix(own, layers.before.rgb / layers.before.a, min(layers.before.a, 1.0));
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(blurred)))) return;
    imageStore(blurred, at, vec4(seen(at), texelFetch(color, at, 0).a));
}
