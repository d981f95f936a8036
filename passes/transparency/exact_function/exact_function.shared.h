// What the exact transmittance function's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_EXACT_FUNCTION_SHARED_H
#define PASSES_TRANSPARENCY_EXACT_FUNCTION_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

struct ExactFunctionParams {
    float pool;  // million fragments kept at a time
    uint accumulation;
};

#ifdef __cplusplus
}
#endif
#endif
