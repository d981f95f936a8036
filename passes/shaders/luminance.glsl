// How bright linear light of the primaries of BT.709 is: one number where a technique keeps no color
// (docs/algorithms/transparency.md 0.3).
#ifndef PASSES_SHADERS_LUMINANCE_GLSL
#define PASSES_SHADERS_LUMINANCE_GLSL

float luminance(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }

#endif
