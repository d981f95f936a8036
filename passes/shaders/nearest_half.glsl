// Half floats that no device can round differently (docs/algorithms/deferred.md 0.3).
#ifndef PASSES_SHADERS_NEAREST_HALF_GLSL
#define PASSES_SHADERS_NEAREST_HALF_GLSL

// The nearest half float, ties to even, as a float: what a store of undefined rounding (docs/algorithms/deferred.md 0.3) then
// keeps as it is. Below the normal half floats only 0 and 2^-14 are used, because subnormals may be flushed.
float nearest_half(float value) {
    const uint bits = floatBitsToUint(value);
    const float size = uintBitsToFloat(bits & 0x7fffffffu);
    if (size < 6.103515625e-05) return size < 3.0517578125e-05 ? 0.0 : (value < 0.0 ? -6.103515625e-05 : 6.103515625e-05);
    if (size >= 65504.0) return value < 0.0 ? -65504.0 : 65504.0;
    return uintBitsToFloat((bits + 0x0fffu + ((bits >> 13) & 1u)) & 0xffffe000u);
}

vec2 nearest_half(vec2 v) { return vec2(nearest_half(v.x), nearest_half(v.y)); }

vec3 nearest_half(vec3 v) { return vec3(nearest_half(v.xy), nearest_half(v.z)); }

#endif
