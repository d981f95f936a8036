// The talk's table of materials (docs/algorithms/deferred.md 1.6): what C++ and shaders share.
#ifndef PASSES_LIGHTING_MATERIAL_TABLE_SHARED_H
#define PASSES_LIGHTING_MATERIAL_TABLE_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::lighting {
#endif

// Cosines of the light along x, of the halfway vector along y, materials in layers. Red is diffuse, green specular.
const uint table_width = 128u;
const uint table_height = 256u;
const uint slice_rough = 0u;  // "Oren-Nayar"
const uint slice_blinn = 1u;
const uint slice_phong = 2u;
const uint slice_metal = 3u;
const uint table_slices = 4u;

// Which slice stands for a recorded material, our choice. A lobe cos^n is as wide as GGX of alpha^2 = 2 / (n + 2), which makes
// the exponents 16, 24 and 128 a roughness of .58, .53 and .35; borders are at the geometric means of their alphas.
const float least_blinn_roughness = 0.43f;
const float least_rough_roughness = 0.55f;
const float least_metal = 0.5f;

// Gloss over reflectance at normal incidence, our choice, too, as the frame has no gloss: the highlight of a slice then reflects
// as much as F0 of uniform light towards an eye on the normal. By slice: pi over the integral of the slice's specular part.
const float gloss_rough = 5.08f;
const float gloss_blinn = 3.66f;
const float gloss_phong = 8.08f;
const float gloss_metal = 6.74f;

#ifdef __cplusplus
}
#endif
#endif
