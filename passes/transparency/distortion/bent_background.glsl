// What is behind transparent layers as they bend it (docs/algorithms/transparency.md 6.13): seen sum d T(z) away, of T the
// luminance.
#ifndef PASSES_TRANSPARENCY_BENT_BACKGROUND_GLSL
#define PASSES_TRANSPARENCY_BENT_BACKGROUND_GLSL
#include "passes/transparency/low_resolution/bilinear.glsl"

// offset: in uv of the image.
vec3 seen_behind(sampler2DArray behind, ivec3 at, vec2 offset) {
    if (offset == vec2(0.0)) return texelFetch(behind, at, 0).rgb;
    const vec2 here = (vec2(at.xy) + 0.5) / vec2(textureSize(behind, 0).xy);
    return bilinear(behind, here + offset, at.z, 3.402823466e38).rgb;
}

#endif
