// A fragment in 64 bits, so that one atomicMin both orders and stores it:
//   bits 63..40 depth, the upper 24 of a positive float's 31 bits, rounded: steps of 2^-17 to 2^-16 of it
//   bits 39..32 what it hides of the light behind it, in 1/256, of which 129 has no code: 0, .5 and 1 are exact
//   bits 31..0  p + e as RGB9E5: HDR to 65408
#ifndef PASSES_TRANSPARENCY_K_BUFFER_KEYS_GLSL
#define PASSES_TRANSPARENCY_K_BUFFER_KEYS_GLSL
#extension GL_ARB_gpu_shader_int64 : require
#include "passes/transparency/codes.glsl"

// Farther than any fragment: infinity, were it a depth.
const uint64_t empty_slot = 0xffffffffffffffffUL;

struct Layer {
    vec3 color;  // p + e
    float alpha;
};

// Depth offsets may bring particles behind the eye; they are all at it.
uint depth_code(float z) { return z > 0.0 ? (floatBitsToUint(z) + 64u) >> 7 : 0u; }

uint alpha_code(float alpha) {
    const uint code = uint(alpha * 256.0 + to_nearest);
    return code > 128u ? code - 1u : code;
}

float alpha_of(uint code) { return float(code > 128u ? code + 1u : code) / 256.0; }

// EXT_texture_shared_exponent: 9 bits a channel, bias 15. The exponent is read from the float's bits: log2() may round up.
uint color_code(vec3 color) {
    const vec3 c = clamp(color, 0.0, 65408.0);
    const float largest = max(c.r, max(c.g, c.b));
    int exponent = max(int(floatBitsToUint(largest) >> 23) - 127, -16) + 16;
    if (largest * power_of_two(24 - exponent) + to_nearest >= 512.0) ++exponent;
    const uvec3 mantissas = uvec3(c * power_of_two(24 - exponent) + to_nearest);
    return mantissas.r | mantissas.g << 9 | mantissas.b << 18 | uint(exponent) << 27;
}

vec3 color_of(uint code) {
    return vec3(uvec3(code, code >> 9, code >> 18) & 0x1ffu) * power_of_two(int(code >> 27) - 24);
}

uint64_t key_of(float z, float alpha, vec3 color) {
    return packUint2x32(uvec2(color_code(color), depth_code(z) << 8 | alpha_code(alpha)));
}

Layer layer_of(uint64_t key) {
    const uvec2 words = unpackUint2x32(key);
    return Layer(color_of(words.x), alpha_of(words.y & 0xffu));
}

#endif
