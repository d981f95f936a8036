// What the draw of a method with a transmittance function adds for an event: see function_draw.h. The shader that includes this,
// after event.glsl, finds T(z) its own way and calls write_event() once.
#ifndef PASSES_TRANSPARENCY_FUNCTION_OUTPUTS_GLSL
#define PASSES_TRANSPARENCY_FUNCTION_OUTPUTS_GLSL
#include "passes/transparency/function.shared.h"
#include "passes/transparency/luminance.glsl"
#include "passes/transparency/optical_depth.glsl"

layout(constant_id = 5) const uint drawn_width = 1u;  // of the targets: the frame's, or half of it
layout(constant_id = 6) const uint drawn_height = 1u;
layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_extinction;
layout(location = 2) out vec4 out_normalizer;
layout(location = 3) out vec4 out_emission;
layout(location = 4) out vec4 out_offset;

// Where the fragment's pixel is, 0 to 1 each way: its center, whichever sample is shaded.
vec2 drawn_place() { return (floor(gl_FragCoord.xy) + 0.5) / vec2(drawn_width, drawn_height); }

// The texel of an image of another extent under the fragment's center. Integers: half-resolution centers lie between texels.
uvec2 texel_under(uvec2 extent) {
    const uvec2 halves = (2u * uvec2(gl_FragCoord.xy) + 1u) * extent;
    return uvec2(halves.x / (2u * drawn_width), halves.y / (2u * drawn_height));
}

// through: T(z) of the event, per channel.
void write_event(Event event, vec3 through) {
    out_color = vec4(min(event.p, largest_radiance) * through, 0.0);
    out_extinction = vec4(optical_depth(event.t), 0.0);
    out_normalizer = vec4((1.0 - event.t) * through, 0.0);
    out_emission = vec4(min(event.e, largest_radiance) * through, 0.0);
    out_offset = vec4(event.d * luminance(through), 0.0, 0.0);
}

#endif
