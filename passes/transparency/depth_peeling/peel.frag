// Keeps the nearest fragment behind the one of the pass before. Depth is that of the fragment, depth offset applied, so that it goes
// into a depth buffer of its own; opaque surfaces are tested here, with the depth of the surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/depth_peeling/depth_peeling.shared.h"
#include "passes/transparency/fragment.glsl"

layout(location = 0) out vec4 out_color;  // p + e
layout(location = 1) out vec4 out_through;
layout(set = 0, binding = 1) uniform sampler2DArray peeled_depth;  // of the pass before; 2: none was, 0: it found nothing
layout(set = 0, binding = 2, scalar) buffer Counters { DepthPeelingCounters counters; };

// Reversed, as the test GREATER_OR_EQUAL wants it. What a depth offset brings before the near plane is at it. Interface layers are
// in front of that; a power of two makes room for them and loses nothing.
float device_depth(float z) {
    if (has_interfaces != 0u) return view.near / z / float(last_interface_layer + 1u);
    return z > view.near ? view.near / z : 1.0;
}

void main() {
    const Fragment fragment = transparent_fragment();
    const ivec3 texel = ivec3(gl_FragCoord.xy, gl_SampleID);
    if (!fragment.visible || gl_FragCoord.z < texelFetch(depth_layers, texel, 0).r) discard;
    atomicAdd(counters.fragments, 1u);
    const float depth = device_depth(fragment.z);
    if (depth >= texelFetch(peeled_depth, texel, 0).r) discard;
    gl_FragDepth = depth;
    out_color = vec4(fragment.p + fragment.e, 0.0);
    out_through = vec4(fragment.t, 1.0);
}
