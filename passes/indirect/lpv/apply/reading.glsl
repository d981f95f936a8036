// How far before a surface cells are read.
#ifndef PASSES_INDIRECT_LPV_READING_GLSL
#define PASSES_INDIRECT_LPV_READING_GLSL

layout(constant_id = 98) const float reading = 0.5;  // cells along the normal

#endif
