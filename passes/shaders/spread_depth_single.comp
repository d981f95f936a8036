// A depth image with one sample as an r32f array with one layer: readers need not know how many samples there are.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D samples;
layout(set = 0, binding = 1, r32f) uniform writeonly image2DArray layers;

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);  // z: the sample
    if (any(greaterThanEqual(at, imageSize(layers)))) return;
    imageStore(layers, at, texelFetch(samples, at.xy, 0));
}
