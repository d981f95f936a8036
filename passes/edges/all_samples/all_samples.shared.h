// What shading every sample's C++ and its shader share.
#ifndef PASSES_EDGES_ALL_SAMPLES_SHARED_H
#define PASSES_EDGES_ALL_SAMPLES_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

struct AllSamplesCounters {
    uint edge_pixels;
};

#ifdef __cplusplus
}
#endif
#endif
