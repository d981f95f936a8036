// Writes the layout of encode.glsl with attributes of the pixel's center.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/inputs_at_center.glsl"
#include "passes/gbuffer/compact/encode.glsl"
#include "passes/gbuffer/fill.glsl"
