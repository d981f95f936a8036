// Attributes of a triangle at the pixel's center: one invocation per pixel and triangle.
#ifndef PASSES_GBUFFER_INPUTS_AT_CENTER_GLSL
#define PASSES_GBUFFER_INPUTS_AT_CENTER_GLSL
#include "passes/shaders/material.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec4 in_uv;
layout(location = 4) in vec4 in_color;
layout(location = 6) flat in uint in_draw;

Varyings varyings() { return Varyings(in_position, in_normal, in_tangent, in_color, gl_FrontFacing); }

vec4 varying_uv() { return in_uv; }

#endif
