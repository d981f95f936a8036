// Writes the layout of encode.glsl with attributes of each sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/inputs_at_sample.glsl"
#include "passes/gbuffer/z_first/encode.glsl"
#include "passes/gbuffer/fill.glsl"
