// Depth of surfaces alone: nothing where none was drawn, whatever kept it from being drawn.
#version 460

layout(set = 0, binding = 0) uniform sampler2DArray drawn_depth;
layout(set = 0, binding = 1) uniform sampler2DArray emission;  // a is 1 on a surface

void main() {
    const ivec3 at = ivec3(gl_FragCoord.xy, gl_SampleID);
    gl_FragDepth = texelFetch(emission, at, 0).a > 0.0 ? texelFetch(drawn_depth, at, 0).r : 0.0;
}
