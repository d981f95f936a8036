// The layers of an array become the samples of a multisampled attachment. gl_SampleID makes it run once per sample.
#version 460

layout(set = 0, binding = 0) uniform sampler2DArray layers;

layout(location = 0) out vec4 out_value;

void main() { out_value = texelFetch(layers, ivec3(gl_FragCoord.xy, gl_SampleID), 0); }
