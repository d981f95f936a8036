// The words of the G-buffer compared bit by bit. 16-bit floats and UNORM texels convert to 32-bit floats without loss, so their bits
// are equal where the words are.
#ifndef PASSES_EDGES_WORDS_GLSL
#define PASSES_EDGES_WORDS_GLSL
#include "passes/gbuffer/words.glsl"

bool bits_differ(vec4 a, vec4 b) { return any(notEqual(floatBitsToUint(a), floatBitsToUint(b))); }

// Of two samples of a pixel; `emission` is declared by the shader that includes this.
bool words_differ(ivec2 pixel, int a, int b) {
    const ivec3 first = ivec3(pixel, a), second = ivec3(pixel, b);
    return bits_differ(texelFetch(gbuffer0, first, 0), texelFetch(gbuffer0, second, 0)) ||
           bits_differ(texelFetch(gbuffer1, first, 0), texelFetch(gbuffer1, second, 0)) ||
           bits_differ(texelFetch(gbuffer2, first, 0), texelFetch(gbuffer2, second, 0)) ||
           bits_differ(texelFetch(emission, first, 0), texelFetch(emission, second, 0));
}

#endif
