// The corners of a tile behind which nothing is seen, at its depth; a tile at the frame's edge ends there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/scene.glsl"
#include "passes/transparency/voxel/zero_depth/zero_depth.shared.h"

layout(constant_id = 10) const uint tile_edge = 16u;
layout(set = 0, binding = 10, scalar) readonly buffer Quads { ZeroQuad quads[]; };

void main() {
    const ZeroQuad quad = quads[gl_InstanceIndex];
    const uvec2 corner = uvec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
    const vec2 place = vec2(min((quad.tile + corner) * tile_edge, view.extent)) / vec2(view.extent);
    gl_Position = vec4(2.0 * place - 1.0, quad.depth, 1.0);
}
