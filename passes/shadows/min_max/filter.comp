// Filtered shadow maps whose bounds answer where all texels of the kernel agree, at every sample; soft lights are filtered like
// the others.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/light_features.shared.h"

const uint shadow_features = feature_shadows;
#include "passes/shadows/visibility.glsl"
#include "passes/shadows/min_max/early_kernel.glsl"

layout(constant_id = 69) const uint verifies = 0u;  // 1: every lookup is done the plain way, too

uvec4 lookups = uvec4(0u);  // of this thread, by class
uint mismatches = 0u;

void count_lookup(uint found) { lookups += uvec4(equal(uvec4(0u, 1u, 2u, 3u), uvec4(found))); }

float fixed_share(uint record, MapPoint p) {
    uint found;
    const float share = early_share(p, found);
    count_lookup(found);
    if (verifies != 0u && floatBitsToUint(share) != floatBitsToUint(fixed_kernel(p))) ++mismatches;
    return share;
}

float outside_share(uint record) {
    count_lookup(class_outside);
    return 1.0;
}

void count_kernels() {
    const uvec4 all = subgroupAdd(lookups);
    const uint wrong = subgroupAdd(mismatches);
    if (!subgroupElect()) return;
    atomicAdd(counters.lit, all.x);
    atomicAdd(counters.shadowed, all.y);
    atomicAdd(counters.expensive, all.z);
    atomicAdd(counters.outside, all.w);
    if (wrong > 0u) atomicAdd(counters.mismatches, wrong);
}
