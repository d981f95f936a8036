// What the draw of a technique with a transmittance function adds for a fragment: see draw.h. The shader that includes this,
// after fragment.glsl, finds T(z) its own way and calls write_fragment() once.
#ifndef PASSES_TRANSPARENCY_FUNCTION_OUTPUTS_GLSL
#define PASSES_TRANSPARENCY_FUNCTION_OUTPUTS_GLSL
#include "passes/transparency/functions/function.shared.h"
#include "passes/shaders/luminance.glsl"
#include "passes/transparency/functions/motion.glsl"
#include "passes/transparency/functions/optical_depth.glsl"
#include "passes/transparency/functions/tint.glsl"

layout(constant_id = 5) const uint drawn_divisor = 1u;  // of the targets: 1, or 2 at half the frame's extent
layout(constant_id = 6) const uint tint = tint_total;
layout(constant_id = 7) const uint moves = 0u;  // 1: the offset is that of motion
layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_extinction;
layout(location = 2) out vec4 out_normalizer;
layout(location = 3) out vec4 out_emission;
layout(location = 4) out vec4 out_offset;

// At least 1: helper lanes read zeros from buffers (lavapipe 22.3).
uvec2 drawn_extent() { return max((view.extent + drawn_divisor - 1u) / drawn_divisor, 1u); }

// Where the fragment's pixel is, 0 to 1 each way: its center, whichever sample is shaded.
vec2 drawn_place() { return (floor(gl_FragCoord.xy) + 0.5) / vec2(drawn_extent()); }

// The texel of an image of another extent under the fragment's center. Integers: half-resolution centers lie between texels.
uvec2 texel_under(uvec2 extent) { return (2u * uvec2(gl_FragCoord.xy) + 1u) * extent / (2u * drawn_extent()); }

// N and X of one channel, and what the skew is made of. through: T(z), one for all channels.
vec4 tinting_weights(inout Fragment fragment, float through) {
    const vec2 depths = skew_depths(fragment.t, through * fog_before_here());
    if (tint == tint_corrected) {
        fragment.p /= skew(depths);
        fragment.e /= skew(depths);
    }
    const float t = luminance(fragment.t);
    return vec4((1.0 - t) * through, optical_depth(t), depths);
}

// Whether write_fragment() cuts off some of its light.
bool is_clamped(Fragment fragment) { return any(greaterThan(max(fragment.p, fragment.e), vec3(largest_radiance))); }

// through: T(z) of the fragment, per channel.
void write_fragment(Fragment fragment, vec3 through) {
    out_extinction = vec4(optical_depth(fragment.t), 0.0);
    out_normalizer = vec4((1.0 - fragment.t) * through, 0.0);
    if (tint != tint_total) out_normalizer = tinting_weights(fragment, through.r);
    out_color = vec4(min(fragment.p, largest_radiance) * through, 0.0);
    out_emission = vec4(min(fragment.e, largest_radiance) * through, 0.0);
    out_offset = vec4(fragment.d * luminance(through), 0.0, 0.0);
    if (moves != 0u) out_offset.xy = pixels_moved(position_here(), in_draw) * luminance((1.0 - fragment.t) * through);
}

#endif
