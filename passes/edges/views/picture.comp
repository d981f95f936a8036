// A picture of what the stage found: the number of surfaces per pixel, or whether the mark of a pixel is right.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/edges/views/surfaces.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 1) const uint shown = shows_surfaces;

layout(set = 0, binding = 0, rgba32f) writeonly uniform image2D picture;

// The colors of the table in edge_views.cpp.
vec3 outcome(ivec2 pixel) {
    const bool is_edge = is_true_edge(pixel), marked = is_marked(pixel);
    if (is_edge) return marked ? vec3(1.0) : vec3(1.0, 0.0, 0.0);
    return marked ? vec3(1.0, 0.8, 0.0) : vec3(0.0, 0.1, 0.3);
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
    vec3 color = vec3(surfaces_of(pixel));
    if (shown == shows_outcome) color = outcome(pixel);
    imageStore(picture, pixel, vec4(color, 1.0));
}
