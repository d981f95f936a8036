// Bounding spheres against the planes of the view's pyramid and its near plane (Gribb and Hartmann 2001).
#ifndef PASSES_CULLING_VIEW_SIDES_GLSL
#define PASSES_CULLING_VIEW_SIDES_GLSL
#include "passes/culling/draw_command.shared.h"
#include "passes/shaders/scene.glsl"

float padded_radius(vec3 center, float bound_radius) { return bound_radius + bound_slack * (1.0 + length(center) + bound_radius); }

vec4 projection_row(int i) {
    return vec4(view.projection[0][i], view.projection[1][i], view.projection[2][i], view.projection[3][i]);
}

// Strictly behind: a sphere that touches the plane stays.
bool behind(vec4 plane, vec3 center, float radius) {
    return dot(plane.xyz, center) + plane.w < -radius * length(plane.xyz);
}

// Of a padded sphere. No far plane: the projection has none. clip.z <= clip.w is the near plane because depth is reversed.
bool outside(vec3 center, float radius) {
    const vec4 x = projection_row(0);
    const vec4 y = projection_row(1);
    const vec4 z = projection_row(2);
    const vec4 w = projection_row(3);
    return behind(w + x, center, radius) || behind(w - x, center, radius) || behind(w + y, center, radius) ||
           behind(w - y, center, radius) || behind(w - z, center, radius);
}

#endif
