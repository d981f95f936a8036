// The farthest opaque depth of the pixels under a texel of the prepass, of all their samples. Depth is reversed: the smallest
// number is the farthest. A texel covers its share of the image, so blocks overlap where the extents do not divide.
#version 460

layout(constant_id = 0) const int divisor = 1;  // of the prepass
layout(set = 0, binding = 0) uniform sampler2DArray depth_layers;
layout(location = 0) out float out_depth;

void main() {
    const ivec3 fine = textureSize(depth_layers, 0);
    const ivec2 coarse = (fine.xy + divisor - 1) / divisor, texel = ivec2(gl_FragCoord.xy);
    const ivec2 first = texel * fine.xy / coarse, end = ((texel + 1) * fine.xy + coarse - 1) / coarse;
    float farthest = 1.0;
    for (int s = 0; s < fine.z; ++s)
        for (int y = first.y; y < end.y; ++y)
            for (int x = first.x; x < end.x; ++x) farthest = min(farthest, texelFetch(depth_layers, ivec3(x, y, s), 0).r);
    out_depth = farthest;
    gl_FragDepth = farthest;
}
