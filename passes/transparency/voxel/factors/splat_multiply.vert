// Hands a vertex on with its triangle's slice as gl_Layer, which must be the same at all three corners. A vertex may belong to several
// triangles; so the draw is not indexed and told places in the list of indices, each of which belongs to one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "passes/shaders/draw_vertex.glsl"
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/factors/triangle_slice.glsl"

void main() {
    const uint base = draws[gl_InstanceIndex].vertex_offset, place = gl_VertexIndex, first = place / 3u * 3u;
    vec3 depths;
    for (uint i = 0u; i < 3u; ++i) {
        const uint vertex = base + indices[first + i];
        depths[i] = view_position(vertex, gl_InstanceIndex).z - depth_offset_of(vertex, gl_InstanceIndex);
    }
    gl_Layer = slice_of_triangle(depths, draws[gl_InstanceIndex].layer);
    hand_on(base + indices[place], gl_InstanceIndex);
}
