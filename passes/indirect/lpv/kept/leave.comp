// What was decided is done: its state is what the next frame finds.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/indirect/lpv/kept/kept.shared.h"

layout(local_size_x = 1) in;

layout(set = 0, binding = 0, scalar) writeonly buffer State { KeptState state; };
layout(set = 0, binding = 1, scalar) readonly buffer Work { KeptWork work; };

void main() { state = work.after; }
