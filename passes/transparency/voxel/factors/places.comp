// 0, 1, 2...: indices with which a vertex shader is told a place in the list of indices, and not the vertex that stands there.
#version 460

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) writeonly buffer Places { uint places[]; };

void main() {
    const uint place = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
    if (place < places.length()) places[place] = place;
}
