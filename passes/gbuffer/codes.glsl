// Integers in half-float channels, and half floats that no device can round differently (docs/algorithms/deferred.md 2.6, 0.3).
#ifndef PASSES_GBUFFER_CODES_GLSL
#define PASSES_GBUFFER_CODES_GLSL
#include "passes/shaders/material_point.glsl"
#include "passes/shaders/nearest_half.glsl"
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

// 8 bits of occlusion under 237 material numbers: 58 steps of metallic for each model that has metals, in their order, then one
// number for each that has none.
const uint metallic_steps = 58u;
const uint first_without_metals = 4u * metallic_steps;

uint material_number(float metallic, uint model) {
    if (!has_metals(model)) return first_without_metals + (model < model_burley ? model : model - 2u);
    const uint place = model <= model_ggx ? model - model_burley : model - model_plain_burley + 2u;
    return place * metallic_steps + uint(floor(clamp(metallic, 0.0, 1.0) * float(metallic_steps - 1u) + 0.5));
}

float pack_material(float occlusion, float metallic, uint lighting_model) {
    const uint levels = uint(floor(clamp(occlusion, 0.0, 1.0) * 255.0 + 0.5));
    return half_of_code(material_number(metallic, lighting_model) * 256u + levels);
}

struct PackedMaterial {
    float occlusion;
    float metallic;
    uint lighting_model;
};

PackedMaterial unpack_material(float value) {
    const uint code = code_of_half(value);
    const uint number = code / 256u;
    const float occlusion = float(code % 256u) / 255.0;
    if (number >= first_without_metals) {
        const uint place = number - first_without_metals;
        return PackedMaterial(occlusion, 0.0, place < 2u ? place : place + 2u);
    }
    const uint place = number / metallic_steps;
    const float metallic = float(number % metallic_steps) / float(metallic_steps - 1u);
    return PackedMaterial(occlusion, metallic, place < 2u ? place + model_burley : place - 2u + model_plain_burley);
}

// Base color with the sRGB curve, so that 8 bits suffice for dark colors, and linear roughness; snapped to the codes of an
// 8-bit target, whose own rounding is the device's choice.
vec4 pack_color(vec3 base_color, float roughness) {
    const vec4 stored = vec4(linear_to_srgb(clamp(base_color, 0.0, 1.0)), clamp(roughness, 0.0, 1.0));
    return floor(stored * 255.0 + 0.5) / 255.0;
}

vec4 unpack_color(vec4 stored) { return vec4(srgb_to_linear(stored.rgb), stored.a); }

#endif
