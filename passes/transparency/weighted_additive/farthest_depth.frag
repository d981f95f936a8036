// The depth that half-resolution fragments are tested against: the farthest of the samples a pixel of it covers, so that none
// is lost that a pixel of the frame would show. At odd sizes a pixel covers parts of three.
#version 460

layout(set = 0, binding = 0) uniform sampler2DArray depth_layers;  // reversed: farther is smaller

void main() {
    const ivec3 size = textureSize(depth_layers, 0);
    const ivec2 low_size = (size.xy + 1) / 2, at = ivec2(gl_FragCoord.xy);
    const ivec2 first = at * size.xy / low_size, last = ((at + 1) * size.xy + low_size - 1) / low_size;
    float farthest = 1.0;
    for (int s = 0; s < size.z; ++s)
        for (int y = first.y; y < last.y; ++y)
            for (int x = first.x; x < last.x; ++x)
                farthest = min(farthest, texelFetch(depth_layers, ivec3(x, y, s), 0).r);
    gl_FragDepth = farthest;
}
