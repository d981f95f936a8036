// How far what is seen has moved since the frame before (docs/algorithms/transparency.md 6.13), in pixels, x right and y down.
// Particles stand still, and so does the camera: captures tell neither where they were.
#ifndef PASSES_TRANSPARENCY_MOTION_GLSL
#define PASSES_TRANSPARENCY_MOTION_GLSL
#include "passes/shaders/camera.glsl"

vec2 pixel_of(vec3 position) {
    const vec2 ndc = view.ndc_scale * position.xy / position.z + view.ndc_offset;
    return (vec2(0.5) + vec2(0.5, -0.5) * ndc) * vec2(view.extent);
}

// Of a point of a draw in view space. What was not in front of the near plane has not been seen to move.
vec2 pixels_moved(vec3 position, uint draw) {
    const vec3 before = position - (draws[draw].motion * vec4(position, 1.0)).xyz;
    return before.z > view.near ? pixel_of(position) - pixel_of(before) : vec2(0.0);
}

#endif
