// The frame's surfaces in their own colors, dim and lit from the eye, so that what is drawn over them has a place; and their depth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/surface_at.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, rgba32f) writeonly uniform image2D picture;
layout(set = 0, binding = 1, r32f) writeonly uniform image2D nearest;

layout(constant_id = 0) const float white = 1.0;  // of light of radiance 1, in the picture's unit

// Of white at the frame's exposure.
const float dim = 0.03;

void main() {
    const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(picture)))) return;
    const Surface s = surface_at(ivec3(at, 0));
    vec3 shade = vec3(0.0);
    if (s.exists) {
        const MaterialPoint m = lit_point(s, uvec2(at));
        const vec3 n = facing_normal(m.lighting_model, m.normal, m.position);
        shade = dim * white / view.exposure * (0.1 + 0.9 * m.base_color) * abs(dot(n, normalize(m.position)));
    }
    imageStore(picture, at, vec4(shade, 1.0));
    imageStore(nearest, at, vec4(s.exists ? s.z : 1e30));
}
