// The depth of each pixel's tile, written one by one: what quads are faster than (docs/algorithms/transparency.md 6.16).
#version 460

layout(constant_id = 10) const uint tile_edge = 16u;
layout(set = 0, binding = 10) uniform sampler2DArray zero_depth;

void main() { gl_FragDepth = texelFetch(zero_depth, ivec3(uvec2(gl_FragCoord.xy) / tile_edge, 0), 0).r; }
