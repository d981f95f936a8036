// The next level of the glow, at half the extent, by the same tent filters.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D finer;
layout(set = 0, binding = 1, rgba16f) writeonly uniform image2D level;

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy), last = textureSize(finer, 0) - 1;
    if (any(greaterThanEqual(texel, imageSize(level)))) return;
    const float weights[4] = float[4](0.125, 0.375, 0.375, 0.125);
    vec3 sum = vec3(0.0);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            sum += weights[x] * weights[y] * texelFetch(finer, clamp(2 * texel + ivec2(x, y) - 1, ivec2(0), last), 0).rgb;
    imageStore(level, texel, vec4(sum, 1.0));
}
