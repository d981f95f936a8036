// draw.vert without an index buffer: a corner is told by its place in the list of indices, and so is the number of its triangle.
// gl_PrimitiveID in a fragment shader would say the same and needs a device with geometry shaders. Corners that triangles share are
// computed for each of them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/draw_vertex.glsl"

void main() {
    const uint draw = gl_InstanceIndex, place = gl_VertexIndex;
    hand_on(draws[draw].vertex_offset + indices[place], draw);
    out_triangle = (place - draws[draw].first_index) / 3u;
}
