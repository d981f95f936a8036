// The dispatch over the list: a thread for every sample but the first of each entry.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/edges/routing/routing.shared.h"

layout(local_size_x = 1) in;
layout(constant_id = 1) const uint further_samples = 3u;

layout(set = 0, binding = 0, r32ui) writeonly uniform uimage2D edge_list;
layout(set = 0, binding = 1, scalar) buffer Dispatch { EdgeDispatch dispatch; };

void main() {
    if (gl_GlobalInvocationID.x > 0u) return;
    const uint groups = (dispatch.count * further_samples + threads_per_group - 1u) / threads_per_group;
    dispatch.x = min(groups, groups_per_row);
    dispatch.y = (groups + groups_per_row - 1u) / groups_per_row;
    dispatch.z = 1u;
    imageStore(edge_list, ivec2(0, imageSize(edge_list).y - 1), uvec4(dispatch.count));
}
