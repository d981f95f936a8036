// What a lookup by the fixed kernel of passes/shaders/shadow_filter.glsl gives where every texel is compared.
#ifndef PASSES_SHADERS_PLAIN_KERNEL_GLSL
#define PASSES_SHADERS_PLAIN_KERNEL_GLSL

float fixed_share(uint record, MapPoint p) { return fixed_kernel(p); }

float outside_share(uint record) { return 1.0; }

#endif
