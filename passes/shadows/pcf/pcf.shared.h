// What percentage-closer filtering's C++ and its shaders share.
#ifndef PASSES_SHADOWS_PCF_SHARED_H
#define PASSES_SHADOWS_PCF_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

struct PcfParams {
    uint kernel;        // 0, 1, 2: 2 x 2, 4 x 4, 8 x 8 texels
    float slope_limit;  // tangent of the steepest angle between normal and light that the bias makes up for
};

struct PcfSlot {
    uint slot;  // the map that is drawn
};

struct PcfCounters {
    uint filtered;
    uint penumbra;
};

#ifdef __cplusplus
}
#endif
#endif
