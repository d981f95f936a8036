// What C++ and GLSL share of the loop that measures how many multiply-adds a device does.
#ifndef PASSES_SHADERS_MULTIPLY_ADD_SHARED_H
#define PASSES_SHADERS_MULTIPLY_ADD_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

const uint multiply_add_threads = 64u;  // of a group

// Both are 1, so that a chain counts what was done; a compiler must not know it.
struct MultiplyAdd {
    float factor, summand;
    uint iterations;
};

#ifdef __cplusplus
}  // namespace strata
#endif
#endif
