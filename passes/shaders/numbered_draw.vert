// draw.vert told a place in the list of indices, where a corner of one triangle stands: so it knows the triangle's number, too, which
// fragments take from a triangle's first corner. gl_PrimitiveID in a fragment shader would say the same and needs a device with
// geometry shaders.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/draw_vertex.glsl"

void main() {
    const uint draw = gl_InstanceIndex, place = gl_VertexIndex;
    hand_on(draws[draw].vertex_offset + indices[place], draw);
    out_triangle = (place - draws[draw].first_index) / 3u;
}
