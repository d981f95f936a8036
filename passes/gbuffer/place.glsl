// The last channel of surface_material (passes/reference/place_code.h).
#ifndef PASSES_GBUFFER_PLACE_GLSL
#define PASSES_GBUFFER_PLACE_GLSL

// x + 4096 y in steps of 1/4096 pixel, over 2^24: exact in a float. 0 is the pixel's center.
float place_code(vec2 offset) {
    const vec2 steps = clamp(floor(offset * 4096.0 + 0.5), -2047.0, 2047.0);
    return (steps.x + 4096.0 * steps.y) / 16777216.0;
}

vec2 offset_of_place_code(float code) {
    const float y = round(code * 4096.0);  // x is below half a step of y
    return vec2(code * 16777216.0 - y * 4096.0, y) / 4096.0;
}

#endif
