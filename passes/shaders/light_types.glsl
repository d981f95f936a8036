// What all lights share: their types, how they end, what cuts them. docs/algorithms/lighting.md 0.3 and 0.4.
#ifndef PASSES_SHADERS_LIGHT_TYPES_GLSL
#define PASSES_SHADERS_LIGHT_TYPES_GLSL
#include "passes/shaders/light_features.shared.h"
#include "passes/shaders/light_types.shared.h"
#include "passes/shaders/scene.glsl"

bool is_asked(uint features, uint feature) { return (features & feature) != 0u; }

// 1 at the light, exactly 0 from its range on: what makes culling by range lossless.
float range_window(LightRecord light, float d) {
    const float share = d / light.range;
    const float rest = clamp(1.0 - share * share * share * share, 0.0, 1.0);
    return d < light.range ? rest * (light.window == window_quartic ? 1.0 : rest) : 0.0;
}

// The sphere around a round cone of half angle below 90 degrees: how far ahead of the apex its center is, and its radius. Up to 45
// degrees it goes through the apex and the rim of the cap, above it is the one around the rim (docs/algorithms/lighting.md 1.4).
vec2 sphere_around_cone(float cosine, float range) {
    const float sine = sqrt(max(0.0, 1.0 - cosine * cosine));
    return cosine >= sine ? vec2(range * (0.5 / cosine)) : range * vec2(cosine, sine);
}

// Whether a clip plane of the light takes the point away.
bool is_clipped(LightRecord light, vec3 position) {
    for (uint i = 0u; i < light.clips; ++i) {
        const ClipPlaneRecord plane = clip_planes[light.first_clip + i];
        if (dot(plane.normal, position) + plane.distance < 0.0) return true;
    }
    return false;
}

#endif
