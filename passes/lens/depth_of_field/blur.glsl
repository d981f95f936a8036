// How much a lens blurs a sample (docs/algorithms/deferred.md 8.7). A point at depth z, seen from places of the lens up to A / 2 off
// its center, moves against the plane in focus at f by A / 2 * (1 - f / z) / f at unit distance: push.scale pixels where z is infinite.
#ifndef PASSES_LENS_BLUR_GLSL
#define PASSES_LENS_BLUR_GLSL
#include "passes/lens/samples.glsl"
#include "passes/shaders/scene.glsl"

layout(constant_id = 20) const uint has_depth = 0u;

layout(set = 0, binding = 10) uniform sampler2DArray depth_layers;  // near / z, 0 where there is no surface
layout(push_constant, scalar) uniform Push { BlurPush push; };

float depth_at(ivec3 at) { return has_depth != 0u ? texelFetch(depth_layers, at, 0).r : 0.0; }

// Radius of the blur in pixels: negative before the plane in focus, positive behind it.
float blur_at(ivec3 at) {
    return clamp(push.scale * (1.0 - push.focus * depth_at(at) / view.near), -push.most, push.most);
}

#endif
