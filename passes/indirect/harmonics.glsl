// Spherical harmonics of two bands, Y = (Y0, Y1 x, Y1 y, Y1 z) (docs/algorithms/lighting.md 5.1).
#ifndef PASSES_INDIRECT_HARMONICS_GLSL
#define PASSES_INDIRECT_HARMONICS_GLSL

// Of Y, and of a lobe max(0, cosine) / pi in it: one watt.
const float y0 = 0.2820947918;
const float y1 = 0.4886025119;
const float watt0 = 0.2820947918;
const float watt1 = 0.3257350079;

#endif
