// Absorbance in front of z from power moments: the canonical representation with a node at z (Muenstermann et al. 2018,
// docs/algorithms/transparency.md 4.5 and 4.8). The matrix is nearly singular by design; every division is guarded.
#ifndef PASSES_TRANSPARENCY_MOMENTS_POWER_GLSL
#define PASSES_TRANSPARENCY_MOMENTS_POWER_GLSL
#include "passes/transparency/moments/warp.glsl"

const float least_pivot = 1e-9;
const float infinite_root = 1e4;

// LDL^T of the Hankel matrix b[i + j], solved for (1, z, z^2, ...).
void solve_hankel(float b[9], float z, out float c[5]) {
    float lower[5][5], pivot[5], y[5];
    float power = 1.0;
    for (uint i = 0u; i < order; ++i) {
        y[i] = power;
        power *= z;
        float diagonal = b[2u * i];
        for (uint j = 0u; j < i; ++j) {
            float sum = b[i + j];
            for (uint k = 0u; k < j; ++k) sum -= lower[i][k] * lower[j][k] * pivot[k];
            lower[i][j] = sum / pivot[j];
            diagonal -= lower[i][j] * sum;
            y[i] -= lower[i][j] * y[j];
        }
        pivot[i] = max(diagonal, least_pivot);
    }
    for (uint i = order; i-- > 0u;) {
        c[i] = y[i] / pivot[i];
        for (uint j = i + 1u; j < order; ++j) c[i] -= lower[j][i] * c[j];
    }
}

// The smaller root first; the other may be infinite. Citardauq's form: no cancellation.
vec2 quadratic_roots(float c0, float c1, float c2) {
    const float root = sqrt(max(c1 * c1 - 4.0 * c0 * c2, 0.0));
    const float q = -0.5 * (c1 + (c1 < 0.0 ? -root : root));
    return vec2(c0 / q, q / c2);
}

// All real, the largest first: 2 sqrt(-p/3) cos((acos .. - 2 half_turn k) / 3) on the depressed form.
vec3 monic_cubic_roots(float a0, float a1, float a2) {
    const float third = a2 / 3.0, p = max(third * third - a1 / 3.0, 0.0), q = third * (third * third - 0.5 * a1) + 0.5 * a0;
    const float radius = sqrt(p), angle = acos(clamp(-q / max(p * radius, 1e-30), -1.0, 1.0)) / 3.0;
    return 2.0 * radius * cos(angle - vec3(0.0, 2.0 * half_turn / 3.0, 4.0 * half_turn / 3.0)) - third;
}

// Ferrari with the largest root of the resolvent, which is positive where all four are real.
vec4 monic_quartic_roots(float a0, float a1, float a2, float a3) {
    const float shift = 0.25 * a3, square = shift * shift;
    const float p = a2 - 6.0 * square;
    const float q = a1 - 2.0 * a2 * shift + 8.0 * square * shift;
    const float r = a0 - a1 * shift + a2 * square - 3.0 * square * square;
    const float z = max(monic_cubic_roots(-q * q, p * p - 4.0 * r, 2.0 * p).x, 1e-20);
    const float root = sqrt(z), half_sum = 0.5 * (p + z), half_gap = 0.5 * q / root;
    const float low = sqrt(max(0.25 * z - half_sum + half_gap, 0.0)), high = sqrt(max(0.25 * z - half_sum - half_gap, 0.0));
    return vec4(-0.5 * root - low, -0.5 * root + low, 0.5 * root - high, 0.5 * root + high) - shift;
}

// One step of Ehrlich and Aberth's method: Newton's, corrected for the other three roots, one of which may be close. It is
// value / (slope - value * (1 / gap + 1 / gap + 1 / gap)), expanded by the product of the gaps.
float polished(float c[5], float x[5], uint i) {
    float value = 0.0, slope = 0.0, product = 1.0, sum = 0.0;
    for (uint k = order; k-- > 0u;) {
        slope = slope * x[i] + value;
        value = value * x[i] + c[k];
    }
    for (uint j = 1u; j <= roots; ++j) {
        if (j == i) continue;
        sum = sum * (x[i] - x[j]) + product;
        product *= x[i] - x[j];
    }
    const float step = value * product / (slope * product - value * sum);
    return abs(step) < 0.1 ? x[i] - step : x[i];
}

// Three or four roots, the one that may be far out or infinite last. All others are in [-1, 1]; in v = 1 / (2 + x), or
// 1 / (2 - x) where the far one is negative, it is near 0 and all are positive, so the leading coefficient is never small.
void find_far_and_near_roots(float c[5], inout float x[5]) {
    const float side = c[roots - 1u] * c[roots] > 0.0 ? -1.0 : 1.0;
    float a[5] = c;
    for (uint i = 1u; i < order; i += 2u) a[i] *= side;
    for (uint first = 0u; first < roots; ++first)
        for (uint i = roots; i-- > first;) a[i] -= 2.0 * a[i + 1u];
    const float scale = 1.0 / a[0];
    if (roots == 3u) {
        const vec3 v = monic_cubic_roots(scale * a[3], scale * a[2], scale * a[1]);
        for (uint i = 0u; i < 3u; ++i) x[i + 1u] = v[i];
    } else {
        const vec4 v = monic_quartic_roots(scale * a[4], scale * a[3], scale * a[2], scale * a[1]);
        for (uint i = 0u; i < 4u; ++i) x[i + 1u] = v[3u - i];
    }
    for (uint i = 1u; i <= roots; ++i) x[i] = side * (1.0 / max(x[i], 1e-6) - 2.0);
    if (roots == 4u)
        for (uint i = 1u; i <= roots; ++i) x[i] = polished(c, x, i);
}

// x[0] = z, then the roots of c; what is at infinity comes last.
void find_nodes(float c[5], float z, out float x[5]) {
    x[0] = z;
    if (roots == 2u) {
        const vec2 found = quadratic_roots(c[0], c[1], c[2]);
        x[1] = found.x;
        x[2] = found.y;
    } else {
        find_far_and_near_roots(c, x);
    }
}

float apart(float a, float b) {
    const float gap = a - b;
    return abs(gap) > 1e-7 ? gap : gap < 0.0 ? -1e-7 : 1e-7;
}

// Share of the absorbance in front of z: b0 = 1 and the others normalized and biased.
float absorbance_before(float b[9], float z, float at_node) {
    float c[5], x[5], f[5];
    solve_hankel(b, z, c);
    find_nodes(c, z, x);
    f[0] = at_node;
    for (uint i = 1u; i <= roots; ++i) f[i] = x[i] < z ? 1.0 : 0.0;
    // Divided differences of the polynomial through (x, f); without the node at infinity it is one degree lower.
    for (uint k = 1u; k <= roots; ++k)
        for (uint i = roots; i >= k; --i) f[i] = (f[i] - f[i - 1u]) / apart(x[i], x[i - k]);
    if (!(abs(x[roots]) < infinite_root)) {
        f[roots] = 0.0;
        x[roots] = 0.0;  // below it is multiplied by 0: infinity would make that NaN
    }
    float q[5];
    for (uint k = 0u; k < 5u; ++k) q[k] = 0.0;
    for (uint i = order; i-- > 0u;) {
        for (uint k = roots; k > 0u; --k) q[k] = q[k - 1u] - x[i] * q[k];
        q[0] = f[i] - x[i] * q[0];
    }
    float sum = 0.0;
    for (uint k = 0u; k < order; ++k) sum += q[k] * b[k];
    return sum;
}

#endif
