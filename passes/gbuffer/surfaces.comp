// The G-buffer of whichever layout, decoded into three float images: for reports, models and debugging, never for the frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/surface_at.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 3, rgba32f) writeonly uniform image2DArray surface_normal;
layout(set = 0, binding = 4, rgba32f) writeonly uniform image2DArray surface_color;
layout(set = 0, binding = 5, rgba32f) writeonly uniform image2DArray surface_material;

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(surface_normal)))) return;
    const Surface s = surface_at(at);
    imageStore(surface_normal, at, s.exists ? vec4(s.normal, s.z) : vec4(0.0));
    imageStore(surface_color, at, s.exists ? vec4(s.base_color, s.roughness) : vec4(0.0));
    imageStore(surface_material, at,
               s.exists ? vec4(float(s.lighting_model), s.metallic, s.occlusion, place_code(s.offset)) : vec4(0.0));
}
