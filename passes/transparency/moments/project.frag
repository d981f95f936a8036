// Adds a fragment's optical depth and its moments to the texel (Muenstermann et al. 2018).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/moments/moments.shared.h"

layout(push_constant, scalar) uniform Push { MomentsPush push; };
#include "passes/transparency/moments/warp.glsl"

layout(early_fragment_tests) in;
layout(constant_id = 11) const uint channel = 3u;  // of transmittance; 3: their luminance
layout(location = 0) out vec4 out_total;
layout(location = 1) out vec4 out_head;
layout(location = 2) out vec4 out_tail;

void main() {
    const Fragment fragment = transparent_fragment();
    const float tau = moment_depth(fragment.t, channel);
    if (!fragment.visible || tau <= 0.0) discard;
    float moments[8];
    fill_moments(warped(fragment.z), moments);
    out_total = vec4(tau, 0.0, 0.0, 0.0);
    out_head = tau * vec4(moments[0], moments[1], moments[2], moments[3]);
    out_tail = tau * vec4(moments[4], moments[5], moments[6], moments[7]);
}
