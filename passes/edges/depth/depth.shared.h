// What the depth test's C++ and its shader share.
#ifndef PASSES_EDGES_DEPTH_SHARED_H
#define PASSES_EDGES_DEPTH_SHARED_H
#include "passes/edges/edges.shared.h"
#ifdef __cplusplus
namespace strata::edges {
#endif

const uint depth_alone = 0u;
const uint depth_and_normal = 1u;
const uint depth_and_material = 2u;
const uint depth_and_both = 3u;

// Depth of four samples is that of one plane where the sums over opposite corners of their parallelogram agree.
struct DepthPush {
    SurfaceLimits limits;
    float residual;  // of the largest depth
};

#ifdef __cplusplus
}
#endif
#endif
