// As given_image.comp, into an image of unsigned numbers.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) readonly buffer Given { vec4 texels[]; };
layout(set = 0, binding = 1) uniform writeonly uimage2DArray image;

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID), size = imageSize(image);
    if (any(greaterThanEqual(at, size))) return;
    imageStore(image, at, uvec4(texels[(at.z * size.y + at.y) * size.x + at.x]));
}
