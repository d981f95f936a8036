// The samples of an image as the layers of an array. No format qualifier: one shader serves every float and unorm format.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DMS samples;
layout(set = 0, binding = 1) uniform writeonly image2DArray layers;

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);  // z: the sample
    if (any(greaterThanEqual(at, imageSize(layers)))) return;
    imageStore(layers, at, texelFetch(samples, at.xy, at.z));
}
