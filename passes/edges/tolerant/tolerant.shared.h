// What the tolerant comparison's C++ and its shader share.
#ifndef PASSES_EDGES_TOLERANT_SHARED_H
#define PASSES_EDGES_TOLERANT_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::edges {
#endif

struct TolerantParams {
    float normal_angle;
    float depth_step;
    float color_step;
};

#ifdef __cplusplus
}
#endif
#endif
