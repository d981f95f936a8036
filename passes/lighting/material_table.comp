// The talk's table of materials (docs/algorithms/deferred.md 1.6), in 8 bits as published: floor(255.5 f). Powers by multiplication
// and roots, where they are whole or halves of halves: a device's pow() is too coarse for the 128th.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/lighting/material_table.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, rgba8) writeonly uniform image2DArray table;

float eighth(float x) {
    const float fourth = x * x * (x * x);
    return fourth * fourth;
}

float thirty_second_root(float x) { return sqrt(sqrt(sqrt(sqrt(sqrt(x))))); }

// Rings where the light is as high over the surface as the halfway vector is.
float metal(float ld, float ls) {
    const float apart = ld - ls;
    const float first = abs(1.0 - abs(0.05 * sin(33.0 * ld) + apart)), second = abs(1.0 - abs(0.05 * cos(33.0 * ld * ls) + apart));
    const float ring = max(max(first, second), abs(1.0 - abs(apart))), by_eight = eighth(ring);
    return by_eight * by_eight * by_eight * pow(ld, 1.0 / 7.0);
}

vec2 material(uint slice, float ld, float ls) {
    const float by_eight = eighth(ls);
    if (slice == slice_rough) return vec2(sqrt(ld) * sqrt(sqrt(ld)), 0.5 * by_eight * by_eight);
    if (slice == slice_blinn) return vec2(ld > 0.0 ? pow(ld, 0.9) : 0.0, by_eight * by_eight * by_eight);
    if (slice == slice_metal) return vec2(ld, ld > 0.0 ? metal(ld, ls) : 0.0);
    const float brighter = eighth(1.01 * ls), by_sixty_four = eighth(brighter);
    return vec2(ld, by_sixty_four * by_sixty_four);
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(table)))) return;
    const float ld = float(at.x) / float(table_width - 1u);
    const float ls = float(at.y) / float(table_height - 1u) * thirty_second_root(ld);
    const vec2 kept = floor(255.5 * min(material(uint(at.z), ld, ls), 1.0)) / 255.0;
    imageStore(table, at, vec4(kept, 0.0, 1.0));
}
