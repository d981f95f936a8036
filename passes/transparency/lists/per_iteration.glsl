// Fragments that a loop over a list takes per iteration: the inner loop is unrolled, which is what saves iterations (passes/shaders/finished.glsl).
#ifndef PASSES_TRANSPARENCY_LISTS_PER_TURN_GLSL
#define PASSES_TRANSPARENCY_LISTS_PER_TURN_GLSL
#extension GL_EXT_control_flow_attributes : require

layout(constant_id = 20) const uint per_iteration = 1u;

#endif
