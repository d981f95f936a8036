// What culling saves, pixel by pixel: red, fragments that pass the test against opaque depth and not the one that culls; green,
// samples whose opaque surface or background is behind that depth. Of all samples of a pixel.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray picture;
layout(set = 0, binding = 1) uniform usampler2DArray drawn;     // fragments
layout(set = 0, binding = 2) uniform usampler2DArray shaded;    // of these
layout(set = 0, binding = 3) uniform sampler2DArray opaque;     // depth
layout(set = 0, binding = 4) uniform sampler2DArray culling;    // depth

void main() {
    const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    const ivec3 size = textureSize(drawn, 0);
    if (any(greaterThanEqual(at, size.xy))) return;
    uint fragments = 0u, hidden = 0u;
    for (int s = 0; s < size.z; ++s) {
        const ivec3 texel = ivec3(at, s);
        fragments += texelFetch(drawn, texel, 0).r - texelFetch(shaded, texel, 0).r;
        hidden += texelFetch(culling, texel, 0).r > texelFetch(opaque, texel, 0).r ? 1u : 0u;
    }
    imageStore(picture, ivec3(at, 0), vec4(fragments, hidden, 0.0, 1.0));
}
