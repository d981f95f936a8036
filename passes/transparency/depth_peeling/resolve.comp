// What was peeled over what was there.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 1) uniform sampler2DArray front;
layout(set = 0, binding = 2) uniform sampler2DArray through;

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(color)))) return;
    const vec4 behind = imageLoad(color, at);
    imageStore(color, at, vec4(texelFetch(front, at, 0).rgb + texelFetch(through, at, 0).rgb * behind.rgb, behind.a));
}
