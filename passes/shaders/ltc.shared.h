// Linearly transformed cosines (Heitz, Dupuy, Hill, Neubelt: Real-Time Polygonal-Light Shading with Linearly Transformed Cosines,
// SIGGRAPH 2016): a clamped cosine, bent by a matrix until it looks like the GGX lobe times its cosine.
#ifndef PASSES_SHADERS_LTC_SHARED_H
#define PASSES_SHADERS_LTC_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

// Interpolated, and integrated over all directions, |difference| is 2 to 7 % of the lobe's albedo for an eye less than 45 degrees
// off the normal, 18 % at 66 degrees and roughness .5, and up to 50 % at 86 degrees; an emitter's reflection is off by half of
// that at the most. 64 x 64 is better below roughness .1 only. The table's rows are roughness i / (ltc_edge - 1), its columns the
// eye's cosine 1 - (j / (ltc_edge - 1))^2.
const uint ltc_edge = 32u;

// The eye is at (sin, 0, cos) of the normal's frame. A direction w of the cosine lobe goes to M w,
//     M = (m11 0 m13; 0 m22 0; m31 0 m33), (m13, m33) of length 1.
struct LtcRecord {
    float m11, m13, m22, m31, m33;
    float albedo;   // share of light from everywhere that the lobe reflects, Fresnel 1
    float fresnel;  // the part of it that Schlick's (1 - l.h)^5 takes: reflected is F0 (albedo - fresnel) + fresnel
};

#ifdef __cplusplus
}
#endif
#endif
