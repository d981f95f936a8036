// From pixels to view space and through the fog. Any shader stage.
#ifndef PASSES_SHADERS_CAMERA_GLSL
#define PASSES_SHADERS_CAMERA_GLSL
#include "passes/shaders/scene.glsl"

// Where the eye's ray through a point of the image goes, z = 1 (docs/algorithms/lighting.md 0.1). Pixel centers are at +.5.
vec3 view_ray(vec2 pixel) {
    const vec2 ndc = vec2(2.0, -2.0) * pixel / vec2(view.extent) + vec2(-1.0, 1.0);
    return vec3((ndc - view.ndc_offset) / view.ndc_scale, 1.0);
}

// Meters from reversed device depth; what was never covered (0) is infinitely far: ask before dividing by it.
float view_z(float device_depth) { return view.near / device_depth; }

vec3 view_position(vec2 pixel, float z) { return view_ray(pixel) * z; }

// Meters of fog before a point in view space, along what they are measured along: fog_by_...
float fog_way(vec3 position, uint path) { return path == fog_by_distance ? length(position) : position.z; }

// Share of the radiance behind so many meters of fog that reaches the eye.
float fog_remains(float meters) { return exp(-view.fog_density * meters); }

// Radiance that so many meters of fog add.
vec3 fog_added(float meters) { return (1.0 - fog_remains(meters)) * view.fog_color; }

vec3 apply_fog(vec3 radiance, float meters) { return radiance * fog_remains(meters) + fog_added(meters); }

#endif
