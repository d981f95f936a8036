// How much of a uniform sky lobes reflect towards an eye at a cosine: fits to quadratures of our own. Row i holds the factors of
// s^i by powers of the lobe's alpha: sum over i, j of row[i][j] s^i alpha^j.
#ifndef PASSES_SHADERS_ALBEDO_FITS_SHARED_H
#define PASSES_SHADERS_ALBEDO_FITS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

// GGX with height-correlated visibility and a Fresnel term of 1 (docs/algorithms/lighting.md T0.7), s = cosine / (cosine +
// alpha): small lobes are alike in cosine / alpha. Never below the truth, so that what is divided by it stays below 1, and at
// most 0.9 % of it above, for alpha from 0.002 to 1 and cosines from 1e-4 to 1.
const vec4 ggx_albedo_fit[6] = {
    vec4(0.990197f, 0.032725f, -0.030720f, -0.000763f),  vec4(-0.072407f, -0.376872f, -4.418835f, 1.373487f),
    vec4(-0.720567f, 3.140868f, 12.914429f, -1.436312f), vec4(0.136797f, -7.523212f, -32.572357f, -3.300684f),
    vec4(2.499090f, 8.032388f, 33.491703f, 26.479931f),  vec4(-1.832466f, -3.649841f, -5.969546f, -33.696251f)};

// The part of it that a Fresnel term of (1 - l.h)^5 leaves, over (1 - cosine)^5; here the powers are of the roughness, not of
// alpha. Times that factor within 0.0052 for roughness from 0.1 and cosines from 0.002, which smaller ones are taken for.
const vec4 ggx_fresnel_fit[6] = {
    vec4(1.194958f, -3.636174f, 4.028169f, -1.542854f),     vec4(-1.007030f, 5.852575f, -9.118623f, 4.051061f),
    vec4(3.234023f, -8.352913f, -4.619511f, 13.683820f),    vec4(-7.437023f, -2.913825f, 103.801870f, -111.625406f),
    vec4(6.786843f, 54.837190f, -309.784599f, 277.213424f), vec4(-1.549145f, -48.774434f, 218.814631f, -147.862229f)};

// Sheen of cloth, s = sqrt(cosine): within 0.0042 for alpha from 0.25 to 1.
const vec4 sheen_albedo_fit[6] = {
    vec4(1.338590f, -2.165077f, 2.476508f, -1.017031f),  vec4(-0.640749f, 2.232517f, -3.248037f, 1.572430f),
    vec4(-6.109932f, 8.533071f, -5.323856f, 0.461427f),  vec4(11.881412f, -12.086615f, 2.286305f, 3.524261f),
    vec4(-10.048592f, 5.483346f, 6.059764f, -7.143584f), vec4(3.543181f, -1.666087f, -2.442663f, 2.644739f)};

#ifdef __cplusplus
}
#endif
#endif
