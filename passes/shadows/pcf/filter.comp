// Percentage-closer filtering (Reeves, Salesin, Cook 1987) of every shadowed light at every sample; soft lights are filtered like
// the others.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/light_features.shared.h"

const uint shadow_features = feature_shadows;
#include "passes/shadows/visibility.glsl"
#include "passes/shaders/plain_kernel.glsl"
#include "passes/shadows/uncounted.glsl"
