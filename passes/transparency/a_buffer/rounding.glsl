// Rounds to what a format holds before it is stored, to nearest: Vulkan lets a store round either way, and where it truncates
// (llvmpipe 22.3 does, R11G11B10F and R16F), .49999997 becomes .4961, in blue .4922.
#ifndef PASSES_TRANSPARENCY_A_BUFFER_ROUNDING_GLSL
#define PASSES_TRANSPARENCY_A_BUFFER_ROUNDING_GLSL
#include "passes/transparency/codes.glsl"

// To a float of 5 bits of exponent and no sign.
float rounded(float x, int mantissa_bits, float largest) {
    const float c = clamp(x, 0.0, largest);
    const int exponent = max(int(floatBitsToUint(c) >> 23) - 127, -14) - mantissa_bits;
    return floor(c * power_of_two(-exponent) + to_nearest) * power_of_two(exponent);
}

vec3 rounded_r11g11b10(vec3 c) { return vec3(rounded(c.r, 6, 65024.0), rounded(c.g, 6, 65024.0), rounded(c.b, 5, 64512.0)); }

float rounded_half(float x) { return rounded(x, 10, 65504.0); }

float rounded_unorm8(float x) { return floor(clamp(x, 0.0, 1.0) * 255.0 + to_nearest) / 255.0; }

#endif
