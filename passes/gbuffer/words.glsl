// The words that the G-buffer holds, whichever layout wrote them. passes/gbuffer/surface_at.h binds them.
#ifndef PASSES_GBUFFER_WORDS_GLSL
#define PASSES_GBUFFER_WORDS_GLSL

layout(set = 0, binding = 20) uniform sampler2DArray gbuffer0;
layout(set = 0, binding = 21) uniform sampler2DArray gbuffer1;
layout(set = 0, binding = 22) uniform sampler2DArray gbuffer2;

#endif
