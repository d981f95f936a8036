// What the test of the mean's C++ and its shader share.
#ifndef PASSES_EDGES_MEAN_SHARED_H
#define PASSES_EDGES_MEAN_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::edges {
#endif

const uint compares_first = 0u;
const uint compares_all = 1u;

#ifdef __cplusplus
}
#endif
#endif
