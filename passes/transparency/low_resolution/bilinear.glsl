// Four texels mixed, edges held. Not the sampler's filter: infinity times a share of zero would be no number, and its shares may
// have eight bits.
#ifndef PASSES_TRANSPARENCY_BILINEAR_GLSL
#define PASSES_TRANSPARENCY_BILINEAR_GLSL

// place: 0 to 1 each way. Numbers count as `largest` at most.
vec4 bilinear(sampler2DArray image, vec2 place, int layer, float largest) {
    const ivec2 last = textureSize(image, 0).xy - 1;
    const vec2 at = clamp(place, -1.0, 2.0) * vec2(last + 1) - 0.5, share = fract(at);
    const ivec2 low = clamp(ivec2(floor(at)), ivec2(0), last), high = clamp(ivec2(floor(at)) + 1, ivec2(0), last);
    vec4 rows[2];
    for (uint row = 0u; row < 2u; ++row) {
        const int y = row == 0u ? low.y : high.y;
        const vec4 left = texelFetch(image, ivec3(low.x, y, layer), 0), right = texelFetch(image, ivec3(high.x, y, layer), 0);
        rows[row] = mix(clamp(left, -largest, largest), clamp(right, -largest, largest), share.x);
    }
    return mix(rows[0], rows[1], share.y);
}

#endif
