// What multi-layer alpha blending's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_MULTI_LAYER_SHARED_H
#define PASSES_TRANSPARENCY_MULTI_LAYER_SHARED_H
#include "passes/transparency/lists/event_lists.shared.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

struct MultiLayerParams {
    uint layers;   // nodes per sample and bucket
    uint buckets;  // depth ranges with nodes of their own
    float pool;    // million fragments kept at a time
};

// Push constants of the blend.
struct MultiLayerPush {
    Band band;
    float log_nearest;      // where the first bucket begins, in ln metres
    float buckets_per_log;  // buckets are equal in ln z
    uint bucket;            // the one that is blended
};

const uint most_layers = 16u;

struct MultiLayerCounters {
    ListCounters lists;
    uint merged;
};

#ifdef __cplusplus
}
#endif
#endif
