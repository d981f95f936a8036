// What the C++ and the shaders of shadow maps share.
#ifndef PASSES_SHADOWS_SHADOWS_SHARED_H
#define PASSES_SHADOWS_SHADOWS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

// A map that is drawn.
struct CastPush {
    uint record;    // in shadows
    uint viewport;  // texels per edge: of the map where it has a layer of its own, else of the whole layer
};

// Of filtering, in the order of the counters' rows.
struct ShadowCounters {
    uint filtered;
    uint penumbra;
    uint kilotexels_drawn;
    uint kilotexels_allocated;
    uint casters_drawn;
    // Of lookups that ask bounds of the map first, by what those say.
    uint lit;
    uint shadowed;
    uint expensive;
    uint outside;
    uint mismatches;
};

// Which of the records lie in shadow_maps, for pictures of them.
struct AtlasPush {
    uint first;   // in shadows
    uint extent;  // texels per edge of a layer
    uint layers;
};

#ifdef __cplusplus
}
#endif
#endif
