// What weighted blending's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_WEIGHTED_SHARED_H
#define PASSES_TRANSPARENCY_WEIGHTED_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

// Equations 7 to 10 of McGuire and Bavoil 2013, McGuire's blog of 2014, and no weight at all (Bavoil and Myers 2008).
const uint weight_w7 = 0u;
const uint weight_w8 = 1u;
const uint weight_w9 = 2u;
const uint weight_w10 = 3u;
const uint weight_blog = 4u;
const uint weight_constant = 5u;

struct WeightedParams {
    uint weight;
    float scale;  // multiplies view depth in metres: the weights were made for 0.1 to 500 units
};

struct WeightedCounters {
    uint fragments;
};

#ifdef __cplusplus
}
#endif
#endif
