// Hands a vertex on with its triangle's slice as gl_Layer, which must be the same at all three corners. A vertex may belong to several
// triangles; so the draw is indexed by the places of the list of indices (places.comp), each of which belongs to one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "passes/shaders/draw_vertex.glsl"
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/factors/triangle_slice.glsl"

void main() {
    const uint base = gl_BaseVertex, place = gl_VertexIndex - base, first = place / 3u * 3u;
    vec3 depths;
    for (uint i = 0u; i < 3u; ++i) {
        const uint vertex = base + indices[first + i];
        depths[i] = view_position(vertex, gl_InstanceIndex).z - vertices[vertex].depth_offset;
    }
    gl_Layer = slice_of_triangle(depths, draws[gl_InstanceIndex].layer);
    hand_on(base + indices[place], gl_InstanceIndex);
}
