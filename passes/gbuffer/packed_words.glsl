// The words of a G-buffer texel: what a layout's pack.glsl makes of a surface.
#ifndef PASSES_GBUFFER_PACKED_WORDS_GLSL
#define PASSES_GBUFFER_PACKED_WORDS_GLSL

struct GBufferWords {
    vec4 g0, g1, g2;  // g2 is 0 in layouts of two images
};

#endif
