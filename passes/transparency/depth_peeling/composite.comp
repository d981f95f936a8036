// Puts the layer just peeled behind those before it, and lets the next pass draw if there was one anywhere.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/transparency/depth_peeling/depth_peeling.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { CompositePush params; };
layout(set = 0, binding = 0, rgba32f) uniform image2DArray front;    // sum T (p + e)
layout(set = 0, binding = 1, rgba32f) uniform image2DArray through;  // product of t
layout(set = 0, binding = 2) uniform sampler2DArray layer_color;
layout(set = 0, binding = 3) uniform sampler2DArray layer_through;
layout(set = 0, binding = 4) uniform sampler2DArray layer_depth;
layout(set = 0, binding = 5, scalar) buffer DrawCounts { uint draw_counts[]; };  // by pass
layout(set = 0, binding = 6, scalar) buffer Counters { DepthPeelingCounters counters; };

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(front)))) return;
    const bool found = texelFetch(layer_depth, at, 0).r > 0.0;
    const uint peeled = subgroupAdd(found ? 1u : 0u);
    if (subgroupElect() && peeled > 0u) {
        atomicAdd(counters.peeled, peeled);
        atomicMax(draw_counts[params.next_pass], params.draws);
    }
    if (!found) return;
    const vec4 remains = imageLoad(through, at);
    imageStore(front, at, imageLoad(front, at) + remains * texelFetch(layer_color, at, 0));
    imageStore(through, at, remains * texelFetch(layer_through, at, 0));
}
