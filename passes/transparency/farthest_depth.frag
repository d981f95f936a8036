// The farthest opaque depth of the pixels under a texel of the prepass, of all their samples. Depth is reversed: the smallest
// number is the farthest. A texel covers its share of the image, so blocks overlap where the extents do not divide.
#version 460

layout(constant_id = 0) const uint width = 1u;  // of the prepass
layout(constant_id = 1) const uint height = 1u;
layout(set = 0, binding = 0) uniform sampler2DArray depth_layers;
layout(location = 0) out float out_depth;

void main() {
    const ivec3 fine = textureSize(depth_layers, 0);
    const ivec2 coarse = ivec2(width, height), texel = ivec2(gl_FragCoord.xy);
    const ivec2 first = texel * fine.xy / coarse, end = ((texel + 1) * fine.xy + coarse - 1) / coarse;
    float farthest = 1.0;
    for (int s = 0; s < fine.z; ++s)
        for (int y = first.y; y < end.y; ++y)
            for (int x = first.x; x < end.x; ++x) farthest = min(farthest, texelFetch(depth_layers, ivec3(x, y, s), 0).r);
    out_depth = farthest;
    gl_FragDepth = farthest;
}
