// Integers in half-float channels, and half floats that no device can round differently (deferred 2.6, 0.3).
#ifndef PASSES_GBUFFER_CODES_GLSL
#define PASSES_GBUFFER_CODES_GLSL
#include "passes/shaders/srgb.glsl"

// Codes 0..61439 are the bit patterns of the normal half floats: 0400..7bff, then 8400..fbff. Subnormals may be flushed and NaN
// payloads may change; 0000, the cleared value, stays free and means "no surface".
const uint code_count = 61440u;
const uint codes_per_sign = 30720u;

float half_of_code(uint code) {
    const uint bits = code < codes_per_sign ? code + 0x0400u : code - codes_per_sign + 0x8400u;
    return unpackHalf2x16(bits).x;
}

// From the bits of the float itself: exact for the normal half floats, 112 = 127 - 15 being the difference of the biases.
uint code_of_half(float value) {
    const uint bits = floatBitsToUint(value);
    return ((bits & 0x7fffffffu) >> 13) - 0x1c000u - 0x0400u + (bits >> 31) * codes_per_sign;
}

// The nearest half float, ties to even, as a float: what a store of undefined rounding (deferred 0.3) then keeps as it is. Below
// the normal half floats only 0 and 2^-14 are used, because subnormals may be flushed.
float nearest_half(float value) {
    const uint bits = floatBitsToUint(value);
    const float size = uintBitsToFloat(bits & 0x7fffffffu);
    if (size < 6.103515625e-05) return size < 3.0517578125e-05 ? 0.0 : (value < 0.0 ? -6.103515625e-05 : 6.103515625e-05);
    if (size >= 65504.0) return value < 0.0 ? -65504.0 : 65504.0;
    return uintBitsToFloat((bits + 0x0fffu + ((bits >> 13) & 1u)) & 0xffffe000u);
}

// 8 bits of occlusion under 240 material numbers: lighting model * 60 + metallic in 60 steps.
float pack_material(float occlusion, float metallic, uint lighting_model) {
    const uint levels = uint(floor(clamp(occlusion, 0.0, 1.0) * 255.0 + 0.5));
    const uint steps = uint(floor(clamp(metallic, 0.0, 1.0) * 59.0 + 0.5));
    return half_of_code((lighting_model * 60u + steps) * 256u + levels);
}

struct PackedMaterial {
    float occlusion;
    float metallic;
    uint lighting_model;
};

PackedMaterial unpack_material(float value) {
    const uint code = code_of_half(value);
    const uint number = code / 256u;
    return PackedMaterial(float(code % 256u) / 255.0, float(number % 60u) / 59.0, number / 60u);
}

// Base color with the sRGB curve, so that 8 bits suffice for dark colors, and linear roughness; snapped to the codes of an
// 8-bit target, whose own rounding is the device's choice.
vec4 pack_color(vec3 base_color, float roughness) {
    const vec4 stored = vec4(linear_to_srgb(clamp(base_color, 0.0, 1.0)), clamp(roughness, 0.0, 1.0));
    return floor(stored * 255.0 + 0.5) / 255.0;
}

vec4 unpack_color(vec4 stored) { return vec4(srgb_to_linear(stored.rgb), stored.a); }

#endif
