// Hands a triangle of draw.vert on with its slice as gl_Layer: for devices whose vertex shaders cannot write that.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/shaders/scene.glsl"
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/factors/triangle_slice.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(location = 0) in vec3 in_position[];
layout(location = 1) in vec3 in_normal[];
layout(location = 2) in vec4 in_tangent[];
layout(location = 3) in vec4 in_uv[];
layout(location = 4) in vec4 in_color[];
layout(location = 5) in vec4 in_emissive[];
layout(location = 6) flat in uint in_draw[];
layout(location = 7) flat in uint in_triangle[];
layout(location = 8) flat in vec4 in_base_color[];
layout(location = 9) flat in uvec4 in_modes[];
layout(location = 10) flat in uvec4 in_texture[];
layout(location = 11) flat in uvec4 in_texture_use[];
layout(location = 12) flat in vec4 in_row0[];
layout(location = 13) flat in vec4 in_row1[];
layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec4 out_tangent;
layout(location = 3) out vec4 out_uv;
layout(location = 4) out vec4 out_color;
layout(location = 5) out vec4 out_emissive;
layout(location = 6) flat out uint out_draw;
layout(location = 7) flat out uint out_triangle;
layout(location = 8) flat out vec4 out_base_color;
layout(location = 9) flat out uvec4 out_modes;
layout(location = 10) flat out uvec4 out_texture;
layout(location = 11) flat out uvec4 out_texture_use;
layout(location = 12) flat out vec4 out_row0;
layout(location = 13) flat out vec4 out_row1;

void hand_on(uint corner) {
    out_position = in_position[corner];
    out_normal = in_normal[corner];
    out_tangent = in_tangent[corner];
    out_uv = in_uv[corner];
    out_color = in_color[corner];
    out_emissive = in_emissive[corner];
    out_draw = in_draw[corner];
    out_triangle = in_triangle[corner];
    out_base_color = in_base_color[corner];
    out_modes = in_modes[corner];
    out_texture = in_texture[corner];
    out_texture_use = in_texture_use[corner];
    out_row0 = in_row0[corner];
    out_row1 = in_row1[corner];
    gl_Position = gl_in[corner].gl_Position;
}

void main() {
    vec3 depths;
    for (uint i = 0u; i < 3u; ++i) depths[i] = in_position[i].z - in_emissive[i].w;
    for (uint i = 0u; i < 3u; ++i) {
        hand_on(i);
        gl_Layer = slice_of_triangle(depths, draws[in_draw[0]].layer);
        EmitVertex();
    }
}
