// Counts pixels by how many surfaces their samples show, and those of them that are marked as edges.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/edges/views/surfaces.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) buffer Counts { SurfaceCounts counts; };

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, textureSize(emission, 0).xy))) return;
    const uint surfaces = min(surfaces_of(pixel), most_surfaces);
    atomicAdd(counts.pixels[surfaces], 1u);
    if (is_marked(pixel)) atomicAdd(counts.marked[surfaces], 1u);
}
