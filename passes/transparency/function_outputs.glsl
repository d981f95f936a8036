// What the draw of a method with a transmittance function adds for an event: see function_draw.h. The shader that includes this,
// after event.glsl, finds T(z) its own way and calls write_event() once.
#ifndef PASSES_TRANSPARENCY_FUNCTION_OUTPUTS_GLSL
#define PASSES_TRANSPARENCY_FUNCTION_OUTPUTS_GLSL
#include "passes/transparency/function.shared.h"
#include "passes/transparency/optical_depth.glsl"

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_extinction;
layout(location = 2) out vec4 out_normalizer;
layout(location = 3) out vec4 out_emission;

// through: T(z) of the event, per channel.
void write_event(Event event, vec3 through) {
    out_color = vec4(min(event.p, largest_radiance) * through, 0.0);
    out_extinction = vec4(optical_depth(event.t), 0.0);
    out_normalizer = vec4((1.0 - event.t) * through, 0.0);
    out_emission = vec4(min(event.e, largest_radiance) * through, 0.0);
}

#endif
