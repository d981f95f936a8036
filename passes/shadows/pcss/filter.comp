// Percentage-closer soft shadows (Fernando 2005) of soft lights and percentage-closer filtering of the others, at every sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/light_features.shared.h"

const uint shadow_features = feature_shadows | feature_soft_shadows;
#include "passes/shadows/visibility.glsl"
#include "passes/shaders/plain_kernel.glsl"
#include "passes/shadows/uncounted.glsl"
