// The first word of a buffer: who keeps it has a reason to make the buffer, and need not read all of it.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 1) in;
layout(set = 0, binding = 0, scalar) readonly buffer From { uint from[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer First { uint first; };

void main() { first = from[0]; }
