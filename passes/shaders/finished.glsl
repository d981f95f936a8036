// Whether this invocation's loops ran as long as they asked to. llvmpipe ends all loops of an invocation, together, after 65,535
// turns (LP_MAX_TGSI_LOOP_ITERATIONS, shared by the lanes of a vector): what was due is not done, and nothing says so but a loop
// that comes after it, which then takes one iteration instead of two.
#ifndef PASSES_SHADERS_FINISHED_GLSL
#define PASSES_SHADERS_FINISHED_GLSL

// `one`: a number of at least 1 that no compiler knows, or it would unroll the loop.
bool finished(uint one) {
    uint iterations = 0u;
    for (uint i = 0u; i < min(one, 1u) + 1u; ++i) iterations = i + 1u;
    return iterations == 2u;
}

#endif
