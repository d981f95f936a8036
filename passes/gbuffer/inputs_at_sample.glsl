// Attributes of a triangle at each sample: one invocation per covered sample, which is what `sample` asks for.
#ifndef PASSES_GBUFFER_INPUTS_AT_SAMPLE_GLSL
#define PASSES_GBUFFER_INPUTS_AT_SAMPLE_GLSL
#include "passes/shaders/material.glsl"

layout(location = 0) sample in vec3 in_position;
layout(location = 1) sample in vec3 in_normal;
layout(location = 2) sample in vec4 in_tangent;
layout(location = 3) sample in vec4 in_uv;
layout(location = 4) sample in vec4 in_color;
layout(location = 6) flat in uint in_draw;

layout(constant_id = 2) const float sample_near = 0.0;  // the near plane; 0: varyings are the sample's

// What takes a varying to the sample. lavapipe 22.3 interpolates `sample` varyings there but divides by the w of the pixel's center
// (docs/algorithms/deferred.md 0.3); gl_FragCoord.z is the sample's. A constant and not view.near: helper lanes read zeros from buffers
// there, and uv needs its derivatives.
float to_sample() { return sample_near > 0.0 ? sample_near / (gl_FragCoord.z * in_position.z) : 1.0; }

Varyings varyings() {
    const float scale = to_sample();
    return Varyings(in_position * scale, in_normal * scale, in_tangent * scale, in_color * scale, gl_FrontFacing);
}

vec4 varying_uv() { return in_uv * to_sample(); }

#endif
