// Reads a prepass at a place between its texels, edges held: by the sampler, whose shares may have eight bits, or in the shader
// where the device cannot filter the format. prepass_read() says which.
#ifndef PASSES_TRANSPARENCY_FILTERED_GLSL
#define PASSES_TRANSPARENCY_FILTERED_GLSL
#include "passes/transparency/low_resolution/bilinear.glsl"

layout(constant_id = 75) const uint filters_in_shader = 0u;

// at: 0 to 1 each way, and the layer.
vec4 filtered(sampler2DArray image, vec3 at) {
    if (filters_in_shader != 0u) return bilinear(image, at.xy, int(at.z), 3.402823466e38);
    return textureLod(image, at, 0.0);
}

#endif
