// What multi-layer alpha blending's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_MULTI_LAYER_SHARED_H
#define PASSES_TRANSPARENCY_MULTI_LAYER_SHARED_H
#include "passes/transparency/lists/pixel_lists.shared.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

const uint most_layers = 16u;

struct MultiLayerCounters {
    ListCounters lists;
    uint merged;
};

#ifdef __cplusplus
}
#endif
#endif
