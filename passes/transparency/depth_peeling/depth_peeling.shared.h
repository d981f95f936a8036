// What depth peeling's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_DEPTH_PEELING_SHARED_H
#define PASSES_TRANSPARENCY_DEPTH_PEELING_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

struct CompositePush {
    uint next_pass;
    uint draws;  // of a pass that has something to peel
};

struct DepthPeelingCounters {
    uint fragments;
    uint peeled;
};

#ifdef __cplusplus
}
#endif
#endif
