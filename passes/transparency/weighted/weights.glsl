// How much a fragment counts in the average (McGuire and Bavoil 2013, equations 7 to 10; docs/algorithms/transparency.md 3.1).
#ifndef PASSES_TRANSPARENCY_WEIGHTED_WEIGHTS_GLSL
#define PASSES_TRANSPARENCY_WEIGHTED_WEIGHTS_GLSL
#include "passes/transparency/weighted/weighted.shared.h"

const float least_weight = 1e-2, largest_weight = 3e3, largest_weight_2015 = 3e2;

float power4(float x) { return x * x * x * x; }
float power6(float x) { return x * x * x * x * x * x; }

float bounded(float weight) { return clamp(weight, least_weight, largest_weight); }

// z scaled view depth, near the scaled near plane, p the premultiplied color.
float weight_of(uint kind, float z, float near, float alpha, vec3 p) {
    if (kind == weight_w7) return alpha * bounded(10.0 / (1e-5 + (z / 5.0) * (z / 5.0) + power6(z / 200.0)));
    if (kind == weight_w8) return alpha * bounded(10.0 / (1e-5 + (z / 10.0) * (z / 10.0) * (z / 10.0) + power6(z / 200.0)));
    const float ninth = bounded(0.03 / (1e-5 + power4(z / 200.0)));
    if (kind == weight_w9) return alpha * ninth;
    // 1 - D of an infinite far plane is near / z.
    if (kind == weight_w10) return alpha * bounded(3e3 * (near / z) * (near / z) * (near / z));
    if (kind == weight_blog) return max(min(1.0, max(p.r, max(p.g, p.b))), alpha) * ninth;
    if (kind == weight_2015 || kind == weight_2015_plain) {
        const float a = 8.0 * min(1.0, alpha) + 0.01;
        float b = 0.05 + 0.95 * near / z;  // 1 - .95 D
        if (kind == weight_2015) b *= inversesqrt(1e4 * z);
        return clamp(1e8 * a * a * a * b * b * b, least_weight, largest_weight_2015);
    }
    return 1.0;
}

#endif
