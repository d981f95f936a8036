// What the wide layout's C++ model and its shaders share.
#ifndef PASSES_GBUFFER_WIDE_SHARED_H
#define PASSES_GBUFFER_WIDE_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::gbuffer {
#endif

// Steps of metallic for each of the 9 lighting models: 61434 of the 61440 codes of a half float.
const uint wide_metallic_steps = 6826u;

#ifdef __cplusplus
}
#endif
#endif
