// What a cell sends through the faces of its neighbors (docs/algorithms/lighting.md 5.4).
#ifndef PASSES_INDIRECT_LPV_FACES_GLSL
#define PASSES_INDIRECT_LPV_FACES_GLSL
#include "passes/indirect/harmonics.glsl"
#include "passes/indirect/lpv/lpv.shared.h"

layout(constant_id = 1) const uint propagation = propagation_linear;
layout(constant_id = 2) const uint faces = faces_centre;
layout(constant_id = 99) const uint lobes = lobes_face;

// Of a neighbor's face ahead and one beside it: the solid angle, and the mean direction times it, ahead and aside.
const float angle_ahead = 0.400669684646, angle_aside = 0.423431354437;
// By statements: lavapipe 22.3 takes the wrong side of a `?:` between two vectors that a specialization constant chooses from.
float moment_ahead() {
    if (faces == faces_centre) return angle_ahead;
    return 0.3874136329;
}
vec2 moment_aside() {
    if (faces == faces_centre) return angle_aside * vec2(0.8944271910, 0.4472135955);
    return vec2(0.3383564674, 0.2193731309);
}

// Direction of the light that a face beside takes: how much of its direction is along the way, and how much across the face.
vec2 lobe_aside() {
    if (lobes == lobes_face) return vec2(0.0, 1.0);
    return vec2(0.8944271910, 0.4472135955);
}

vec3 aside_of(vec3 d, vec3 f) { return moment_aside().x * d + moment_aside().y * f; }

// W through a face of the neighbor in direction `moment`, which has the length of the face's moment; not less than nothing.
float flux(vec4 light, float angle, vec3 moment) {
    return max(angle * y0 * light.x + y1 * dot(light.yzw, moment), 0.0);
}

vec3 unit(uint axis, float direction) {
    vec3 d = vec3(0.0);
    d[axis] = direction;
    return d;
}

// The sum below where no face is clamped, in closed form: what opposite faces send of l0 and of l1 along the axis cancels.
vec4 through_unclamped_faces(vec4 light, uint axis, float direction) {
    const float along = y1 * light[axis + 1u];
    const float aside = 4.0 * (direction * angle_aside * y0 * light.x + moment_aside().x * along);
    vec4 sum = vec4(0.0, 2.0 * moment_aside().y * lobe_aside().y * y1 * light.yzw);
    sum[axis + 1u] = direction * angle_ahead * y0 * light.x + moment_ahead() * along + lobe_aside().x * aside;
    sum.x = (angle_ahead + 4.0 * angle_aside) * y0 * light.x + direction * (moment_ahead() + 4.0 * moment_aside().x) * along;
    return sum;
}

// W that a cell sends along an axis, and the sum of the faces' directions weighted by it.
vec4 through_faces(vec4 light, uint axis, float direction) {
    if (propagation == propagation_linear) return through_unclamped_faces(light, axis, direction);
    const vec3 d = unit(axis, direction);
    const float ahead = flux(light, angle_ahead, moment_ahead() * d);
    vec4 sum = ahead * vec4(1.0, d);
    for (uint k = 0u; k < 4u; ++k) {
        const vec3 f = unit((axis + 1u + k / 2u) % 3u, k % 2u == 0u ? 1.0 : -1.0);
        sum += flux(light, angle_aside, aside_of(d, f)) * vec4(1.0, lobe_aside().x * d + lobe_aside().y * f);
    }
    return sum;
}

// What faces are multiplied by, so that all thirty together take what the cell holds although none takes less than nothing.
float share_sent(vec4 light) {
    if (propagation != propagation_energy_true) return 1.0;
    float sum = 0.0;
    for (uint i = 0u; i < 6u; ++i) sum += through_faces(light, i / 2u, i % 2u == 0u ? 1.0 : -1.0).x;
    return sum > 0.0 ? light.x / (y0 * sum) : 0.0;
}

// What a cell sends along an axis, as the cell there takes it.
vec4 sent(vec4 light, float share, uint axis, float direction) {
    return vec4(watt0, vec3(watt1)) * through_faces(light, axis, direction) * share;
}

#endif
