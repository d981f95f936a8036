// Whether this invocation is a helper: its quad needs its derivatives, it covers nothing, and its atomics do nothing and return
// anything. A loop that waits for an atomic must not run in one. On GPUs a fragment that an early depth test has ended can be a
// helper although its sample is covered.
#ifndef PASSES_SHADERS_HELPER_INVOCATIONS_GLSL
#define PASSES_SHADERS_HELPER_INVOCATIONS_GLSL

layout(constant_id = 74) const uint tells_helpers = 0u;  // 1: gl_HelperInvocation may be read, which ends llvmpipe 22.3

bool is_helper() {
    if (gl_SampleMaskIn[0] == 0) return true;
    if (tells_helpers != 0u) return gl_HelperInvocation;
    return false;
}

#endif
