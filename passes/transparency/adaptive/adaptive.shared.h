// What adaptive transparency's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_ADAPTIVE_SHARED_H
#define PASSES_TRANSPARENCY_ADAPTIVE_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

// A step of the curve: transmittance behind z. Unused nodes are infinitely far.
struct CurveNode {
    float z;
    vec3 t;
};

const uint most_curve_nodes = 16u;

#ifdef __cplusplus
}
#endif
#endif
