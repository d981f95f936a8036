// X-Ray's ambient occlusion with its published constants (docs/algorithms/deferred.md 8.4): taps on rings in the picture, each weighed by
// how far it is above the surface and how near.
#ifndef PASSES_OCCLUSION_SSAO_XRAY_GLSL
#define PASSES_OCCLUSION_SSAO_XRAY_GLSL
#include "passes/occlusion/ssao/estimate.glsl"

const float two_pi = 6.28318530717959;
const float tangent_67_5 = 0.668178637919299;    // of half the field of view that the constants were made for
const float least_depth = 1.3;                   // meters: the rings of nearer surfaces are not wider
const vec2 kernel = 75.0 / vec2(1024.0, 768.0);  // of the picture, at 1 m

// Ring i of n has the share i / n of the radius and is turned by half a direction more than the one inside it: the chapter does
// not say. Taps beyond the border read the border, as a sampler that clamps does.
float xray_visibility(Center c, inout Tally tally) {
    const vec2 radius = kernel * (tangent_67_5 * abs(view.ndc_scale.y) / max(c.place.position.z, least_depth)) * vec2(view.extent);
    float weights = 0.0, dark = 0.0;
    for (uint ring = 1u; ring <= steps; ++ring)
        for (uint i = 0u; i < directions; ++i) {
            const float angle = two_pi * (float(i) + 0.5 * float(ring) + c.noise.x) / float(directions);
            const vec2 tapped = c.pixel + radius * (float(ring) / float(steps)) * vec2(cos(angle), sin(angle));
            const ivec2 at = clamp(ivec2(floor(tapped)), ivec2(0), ivec2(view.extent) - 1);
            ++tally.taps;
            const Place tap = place_at(ivec3(at, c.sample_index));
            const vec3 d = tap.position - c.place.position;
            const float away = length(d);
            if (!tap.exists || away < 1e-6 || away >= push.radius) continue;
            ++tally.in_reach;
            const float above = max(0.0, dot(d, c.place.normal) / away);
            const float weight = (above + 0.01) * (1.0 - away / push.radius);
            weights += weight;
            dark += weight * above * (1.0 - min(away, 1.0));
        }
    return weights < 1e-6 ? 1.0 : 1.0 - dark / weights / 1.2;
}

#endif
