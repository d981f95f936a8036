// The sRGB curve (IEC 61966-2-1), both ways.
#ifndef PASSES_SHADERS_SRGB_GLSL
#define PASSES_SHADERS_SRGB_GLSL

vec3 srgb_to_linear(vec3 c) {
    const vec3 low = c / 12.92;
    const vec3 high = pow((c + 0.055) / 1.055, vec3(2.4));
    return mix(high, low, lessThanEqual(c, vec3(0.04045)));
}

vec3 linear_to_srgb(vec3 c) {
    const vec3 low = c * 12.92;
    const vec3 high = 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(c, vec3(0.0031308)));
}

#endif
