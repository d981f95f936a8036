// What weighted blending's C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_WEIGHTED_SHARED_H
#define PASSES_TRANSPARENCY_WEIGHTED_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

// Equations 7 to 10 of McGuire and Bavoil 2013, McGuire's blog of 2014, his form of 2015 with and without its depth range, and
// no weight at all.
const uint weight_w7 = 0u;
const uint weight_w8 = 1u;
const uint weight_w9 = 2u;
const uint weight_w10 = 3u;
const uint weight_blog = 4u;
const uint weight_2015 = 5u;
const uint weight_2015_plain = 6u;
const uint weight_constant = 7u;

// What the sums become: the average over the product of transmittances; the same over the mean alpha to the number of layers
// (Bavoil and Myers 2008); or a plain sum (Meshkin 2007). The latter two know no weight.
const uint form_normalized = 0u;
const uint form_average = 1u;
const uint form_sum = 2u;

struct WeightedParams {
    uint weight;
    float scale;  // multiplies view depth in meters: the weights were made for 0.1 to 500 units
    uint form;
};

struct WeightedCounters {
    uint fragments;
    uint weights_differ;
    uint nearest_inverted;  // bits of the least depth, inverted because counters begin at 0
    uint farthest;          // bits of the largest
};

#ifdef __cplusplus
}
#endif
#endif
