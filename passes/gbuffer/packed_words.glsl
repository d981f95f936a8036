// The words of a G-buffer texel: what a layout's pack.glsl makes of a surface.
#ifndef PASSES_GBUFFER_PACKED_WORDS_GLSL
#define PASSES_GBUFFER_PACKED_WORDS_GLSL
#include "passes/gbuffer/codes.glsl"

struct GBufferWords {
    vec4 g0, g1, g2;  // g2 is 0 in layouts of two images
};

// Of layouts that keep a material as a code and base color with roughness in 8 bits each (coded_surface.glsl reads it).
GBufferWords coded_words(vec2 normal, float depth, MaterialPoint m) {
    GBufferWords words;
    words.g0 = vec4(normal, depth, pack_material(m.occlusion, m.metallic, m.lighting_model));
    words.g1 = pack_color(m.base_color, m.roughness);
    words.g2 = vec4(0.0);
    return words;
}

#endif
