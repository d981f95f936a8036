// A level of the glow at twice its extent: three quarters of the nearest texel each way and one of the next, the border held.
#ifndef PASSES_LENS_DOUBLED_GLSL
#define PASSES_LENS_DOUBLED_GLSL

vec3 doubled(sampler2D coarser, ivec2 texel) {
    const ivec2 last = textureSize(coarser, 0) - 1;
    const ivec2 near = min(texel >> 1, last), next = clamp((texel >> 1) + 2 * (texel & 1) - 1, ivec2(0), last);
    return 0.5625 * texelFetch(coarser, near, 0).rgb + 0.0625 * texelFetch(coarser, next, 0).rgb +
           0.1875 * (texelFetch(coarser, ivec2(near.x, next.y), 0).rgb + texelFetch(coarser, ivec2(next.x, near.y), 0).rgb);
}

#endif
