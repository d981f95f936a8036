// Fragments beyond those that a technique keeps, of the pixel's worst sample.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { uint kept; };
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray picture;
layout(set = 0, binding = 1, r32ui) uniform readonly uimage2DArray layers;

void main() {
    const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    const ivec3 size = imageSize(layers);
    if (any(greaterThanEqual(at, size.xy))) return;
    uint most = kept;
    for (int s = 0; s < size.z; ++s) most = max(most, imageLoad(layers, ivec3(at, s)).r);
    imageStore(picture, ivec3(at, 0), vec4(vec3(float(most - kept)), 1.0));
}
