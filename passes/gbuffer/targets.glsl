// The targets that every layout writes. Layouts with a third one declare it at location 3: emission has location 2.
#ifndef PASSES_GBUFFER_TARGETS_GLSL
#define PASSES_GBUFFER_TARGETS_GLSL

layout(location = 0) out vec4 gbuffer0;
layout(location = 1) out vec4 gbuffer1;

#endif
