// The ray through a sample, from the eye to its surface, and how much of the sun's light the air along it scatters.
#ifndef PASSES_SUN_SHAFTS_RAY_GLSL
#define PASSES_SUN_SHAFTS_RAY_GLSL
#include "passes/shaders/camera.glsl"
#include "passes/shaders/sample_places.glsl"
#include "passes/sun_shafts/march.shared.h"

layout(constant_id = 1) const uint normalization = normalization_physical;
layout(constant_id = 13) const uint phase = phase_isotropic;

layout(set = 0, binding = 2) uniform sampler2DArray depth_layers;
layout(push_constant, scalar) uniform Push { MarchPush push; };

struct ShaftRay {
    vec3 direction;  // unit
    float meters;    // its length
    float z;         // view depth of its end
};

float end_depth(ivec3 at) {
    const float depth = texelFetch(depth_layers, at, 0).r;
    return depth > 0.0 ? min(view_z(depth), push.far) : push.far;
}

// Reach of lit shares: relative difference of depths at which a neighbor counts half.
const float depth_tolerance = 1.0 / 32.0;

float fit(float z, float other) {
    const float off = (other - z) / (depth_tolerance * min(z, other));
    return 1.0 / (1.0 + off * off);
}

// x and y: the pixel; z: the sample.
ShaftRay ray_to(ivec3 at) {
    const vec3 ray = view_ray(vec2(at.xy) + 0.5 + sample_place(view.samples, uint(at.z)));
    const float z = end_depth(at), per_depth = length(ray);
    return ShaftRay(ray / per_depth, per_depth * z, z);
}

// 1 - exp(-x), good to float precision for small x, too.
float lost(float x) { return x < 0.03125 ? x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x / 24.0))) : 1.0 - exp(-x); }

// What a ray that is lit throughout scatters, as a share of push.radiance.
float scattered(float meters) { return normalization == normalization_steps ? 1.0 : lost(view.fog_density * meters); }

// What a ray's direction makes of isotropic scattering: 1 on average over all directions (Henyey, Greenstein: Diffuse Radiation
// in the Galaxy, 1941).
float phase_factor(vec3 direction) {
    if (phase != phase_henyey_greenstein) return 1.0;
    const float g = push.asymmetry, spread = 1.0 + g * g - 2.0 * g * dot(direction, push.to_sun);
    return (1.0 - g * g) / (spread * sqrt(spread));
}

#endif
