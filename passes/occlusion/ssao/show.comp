// The first sample's visibility in gray.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray visibility;
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D shown;

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(shown)))) return;
    const ivec2 size = textureSize(visibility, 0).xy;
    const int divisor = (imageSize(shown).x + size.x - 1) / size.x;
    imageStore(shown, pixel, vec4(vec3(texelFetch(visibility, ivec3(pixel / divisor, 0), 0).r), 1.0));
}
