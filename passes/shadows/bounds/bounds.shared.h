// What the C++ and the shaders that build bounds of shadow maps share.
#ifndef PASSES_SHADOWS_BOUNDS_SHARED_H
#define PASSES_SHADOWS_BOUNDS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

// A map whose bounds are built.
struct BoundsPush {
    uvec2 offset;  // texels: of its upper left texel in the layer
    uint layer;
    uint size;     // texels per edge
    uint is_face;  // 1: beyond the map's edge its outermost texels go on; 0: nothing is drawn there
};

#ifdef __cplusplus
}
#endif
#endif
