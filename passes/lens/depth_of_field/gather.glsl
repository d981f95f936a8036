// Taps of depth of field (docs/algorithms/deferred.md 8.7): where they lie, and the share of the light of each that falls on a pixel.
// Half of the taps fill the disc of the largest blur that reaches the pixel, half that of the pixel's own.
#ifndef PASSES_LENS_GATHER_GLSL
#define PASSES_LENS_GATHER_GLSL
#include "passes/lens/depth_of_field/blur.glsl"
#include "passes/shaders/hash.shared.h"

layout(constant_id = 1) const uint taps = 64u;

layout(set = 0, binding = 1) uniform sampler2D spread;

const float pi = 3.14159265;
const float sharp = 0.5;                                      // pixels: a disc that is no wider than its pixel
const vec2 golden = vec2(-0.737368878078320, 0.675490294261524);  // cosine and sine of pi (3 - sqrt(5))

struct Center {
    ivec3 at;
    float blur, outer, inner;  // pixels: own blur, radii of the two discs of taps
};

// The largest blur that reaches the pixel, in pixels.
float reach_at(ivec3 at) { return texelFetch(spread, at.xy / int(blur_tile), 0).r; }

Center center_at(ivec3 at) {
    const float blur = blur_at(at), outer = reach_at(at) + 0.5;
    return Center(at, blur, outer, min(abs(blur) + 0.5, outer));
}

// Pixels of the picture that a tap stands for, by how densely both discs together lie around it.
float area(Center c, float away) {
    const float inside_inner = clamp(c.inner - away + 0.5, 0.0, 1.0);
    return pi / (0.5 * float(taps) * (1.0 / (c.outer * c.outer) + inside_inner / (c.inner * c.inner)));
}

float disc_area(float blur) { return max(1.0, pi * blur * blur); }

// The sample that a tap reads, and what it gives to the layers before the pixel's surface, on it and behind it. The pixel itself
// gives nothing here.
struct Tap {
    ivec2 pixel;
    float before, on, behind;
};

Tap tap_at(Center c, vec2 offset) {
    const ivec2 pixel = clamp(ivec2(floor(vec2(c.at.xy) + 0.5 + offset)), ivec2(0), textureSize(color, 0).xy - 1);
    const ivec2 apart = pixel - c.at.xy;
    if (apart == ivec2(0)) return Tap(pixel, 0.0, 0.0, 0.0);
    const float away = length(vec2(apart)), blur = blur_at(ivec3(pixel, c.at.z)), deeper = blur - c.blur;
    const float before = clamp(-deeper, 0.0, 1.0), behind = clamp(deeper, 0.0, 1.0);
    const float pixels = area(c, away);
    const float thrown = pixels * clamp(abs(blur) - away + 0.5, 0.0, 1.0) / disc_area(blur);
    // What is nearest to the surface's border stands for what it hides.
    const float near_by = pixels * clamp(c.inner - away + 0.5, 0.0, 1.0) / (away * away);
    return Tap(pixel, before * thrown, (1.0 - before - behind) * thrown, behind * near_by);
}

// Distance of a pair of taps from the center, as a share of their disc's radius.
float from_center(uint pair) { return sqrt((float(pair) + 0.5) / (0.5 * float(taps))); }

// The direction of the first pair of taps, by arithmetic alone: a driver's sine could put a tap into another pixel.
vec2 first_way(ivec3 at) {
    const float t = float(hashed(view.seed, uvec3(at.xy, 0u)) >> 16u) / 32768.0 - 1.0;
    return vec2(1.0 - t * t, 2.0 * t) / (1.0 + t * t);
}

vec2 next_way(vec2 way) { return vec2(way.x * golden.x - way.y * golden.y, way.x * golden.y + way.y * golden.x); }

#endif
