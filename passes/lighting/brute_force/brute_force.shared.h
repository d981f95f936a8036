// What brute-force lighting's C++ and its shader share.
#ifndef PASSES_LIGHTING_BRUTE_FORCE_SHARED_H
#define PASSES_LIGHTING_BRUTE_FORCE_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::lighting {
#endif

struct BruteForceCounters {
    uint evaluations;
    uint samples_shaded;
    uint unfinished;
};

#ifdef __cplusplus
}
#endif
#endif
