// 1 in the fixed point of what surfaces reflect of a grid's light: the largest power of two at which a cell may take what 64 faces of a
// cell reflect of its brightest cell. Reflected light cannot be bounded before it is known: cells add up all that passes them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/grid.glsl"
#include "passes/indirect/lpv/read_total.glsl"
#include "passes/shaders/finished.glsl"

layout(local_size_x = 256) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };
layout(set = 0, binding = 1, scalar) writeonly buffer Scale { float fixed_one; };
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

// Irradiance is 4 of these at most, by either rule, where cells are a meter wide; what is injected of it is watt1 at most.
float brightness(vec4 light) { return y0 * light.x + y1 * length(light.yzw); }
const float most_faces = 64.0;

shared float most[256];

void main() {
    const uint thread = gl_LocalInvocationIndex;
    float found = 0.0;
    for (uint i = thread; i < grid.cells.x * grid.cells.y * grid.cells.z; i += 256u) {
        const LightCell light = total_light(i);
        found = max(found, max(brightness(light.red), max(brightness(light.green), brightness(light.blue))));
    }
    most[thread] = found;
    for (uint reach = 128u; reach > 0u; reach /= 2u) {
        barrier();
        if (thread < reach) most[thread] = max(most[thread], most[thread + reach]);
    }
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
    if (thread > 0u) return;
    const float one = float(most_of_a_sum) / (4.0 * watt1 * most_faces * max(most[0], 1e-30));
    fixed_one = uintBitsToFloat(floatBitsToUint(one) & 0x7f800000u);  // without its mantissa
}
