// What techniques that compare the samples of a pixel share: what they count, and the limits of their tests.
#ifndef PASSES_EDGES_SHARED_H
#define PASSES_EDGES_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::edges {
#endif

struct EdgeCounters {
    uint plain_pixels;
    uint edge_pixels;
    uint sky_pixels;
    uint edge_samples;
};

// Tests of two samples' surfaces, as bits.
const uint test_normal = 1u;
const uint test_depth = 2u;
const uint test_material = 4u;

// Beyond these, two surfaces differ (docs/algorithms/deferred.md 3.2, D2).
struct SurfaceLimits {
    float least_cosine;  // of the angle between the normals
    float depth_step;    // of the smaller view depth
    float color_step;    // sum over the channels
};

#ifdef __cplusplus
}
#endif
#endif
