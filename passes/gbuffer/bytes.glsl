// 32 bits as the four bytes of an rgba8 texel: every device stores k / 255 as k and gives it back, at 1 and at 4 samples.
#ifndef PASSES_GBUFFER_BYTES_GLSL
#define PASSES_GBUFFER_BYTES_GLSL

vec4 pack_bytes(uint word) { return vec4(word & 255u, word >> 8 & 255u, word >> 16 & 255u, word >> 24) / 255.0; }

uint unpack_bytes(vec4 stored) {
    const uvec4 bytes = uvec4(stored * 255.0 + 0.5);
    return bytes.x | bytes.y << 8 | bytes.z << 16 | bytes.w << 24;
}

#endif
