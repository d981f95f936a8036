// What frustum culling's C++ and its shader share.
#ifndef PASSES_CULLING_FRUSTUM_SHARED_H
#define PASSES_CULLING_FRUSTUM_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

struct FrustumList {
    uint first;  // command of the list's draw 0
    uint count;  // draws in the list
};

struct FrustumCounters {
    uint tested;
    uint culled;
};

#ifdef __cplusplus
}
#endif
#endif
