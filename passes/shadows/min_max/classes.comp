// The same lookups as filter.comp does, for the view of a light's classes and the table of lookups by map.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/light_features.shared.h"

const uint shadow_features = feature_shadows;
#include "passes/shadows/visibility.glsl"
#include "passes/shadows/min_max/early_kernel.glsl"

layout(constant_id = 69) const uint shown_light = 0u;  // whose classes the picture shows, in lights

layout(set = 0, binding = 7, rgba32f) writeonly uniform image2DArray picture;
layout(set = 0, binding = 8, scalar) buffer MapClasses { uvec4 map_classes[]; };  // by slot

const uint class_none = 4u;
uint shown_class = class_none;

// Where two cascades blend, the costlier lookup is shown.
void see(uint record, uint found) {
    atomicAdd(map_classes[record - shadow_allocation * view.shadow_count][found], 1u);
    if (shadows[record].light != shown_light) return;
    if (shown_class >= class_outside) shown_class = found;
    else if (found != class_outside) shown_class = max(shown_class, found);
}

float fixed_share(uint record, MapPoint p) {
    uint found;
    const float share = early_share(p, found);
    see(record, found);
    return share;
}

float outside_share(uint record) {
    see(record, class_outside);
    return 1.0;
}

// Lit yellow, shadowed blue, expensive red, outside gray, no lookup black.
vec3 color_of(uint found) {
    if (found == class_lit) return vec3(1.0, 0.9, 0.4);
    if (found == class_shadowed) return vec3(0.0, 0.1, 0.4);
    if (found == class_expensive) return vec3(1.0, 0.0, 0.0);
    return found == class_outside ? vec3(0.3) : vec3(0.0);
}

void count_kernels() {
    if (gl_GlobalInvocationID.z == 0u) imageStore(picture, ivec3(gl_GlobalInvocationID.xy, 0), vec4(color_of(shown_class), 1.0));
}
