// Absorbance in front of z from trigonometric moments: the same on the unit circle, where the matrix is Toeplitz and the nodes are
// complex numbers of length 1 (Muenstermann et al. 2018, docs/algorithms/transparency.md 4.6).
#ifndef PASSES_TRANSPARENCY_MOMENTS_TRIGONOMETRIC_GLSL
#define PASSES_TRANSPARENCY_MOMENTS_TRIGONOMETRIC_GLSL
#include "passes/transparency/moments/power.glsl"

vec2 conjugate(vec2 a) { return vec2(a.x, -a.y); }
vec2 times(vec2 a, vec2 b) { return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x); }
vec2 over(vec2 a, vec2 b) { return times(a, conjugate(b)) / max(dot(b, b), 1e-30); }
vec2 polar(float angle) { return vec2(cos(angle), sin(angle)); }

vec2 square_root(vec2 a) {
    const float size = length(a);
    const vec2 root = sqrt(max(0.5 * vec2(size + a.x, size - a.x), 0.0));
    return vec2(root.x, a.y < 0.0 ? -root.y : root.y);
}

vec2 cube_root(vec2 a) {
    const float size = length(a);
    return size > 0.0 ? pow(size, 1.0 / 3.0) * polar(atan(a.y, a.x) / 3.0) : vec2(0.0);
}

// The one of a + b and a - b that is longer.
vec2 longer(vec2 a, vec2 b) { return dot(a, b) >= 0.0 ? a + b : a - b; }

void complex_quadratic(vec2 c0, vec2 c1, vec2 c2, out vec2 x[5]) {
    const vec2 q = -0.5 * longer(c1, square_root(times(c1, c1) - 4.0 * times(c0, c2)));
    x[1] = over(c0, q);
    x[2] = over(q, c2);
}

// Cardano, with the sum that does not cancel.
void complex_monic_cubic(vec2 a0, vec2 a1, vec2 a2, out vec2 x[5]) {
    const vec2 third = a2 / 3.0, p = a1 / 3.0 - times(third, third);
    const vec2 q = times(third, times(third, third) - 0.5 * a1) + 0.5 * a0;
    const vec2 u = cube_root(longer(-q, square_root(times(q, q) + times(p, times(p, p)))));
    const vec2 v = -over(p, u), turn = vec2(-0.5, 0.8660254037844386);
    x[1] = u + v - third;
    x[2] = times(u, turn) + times(v, conjugate(turn)) - third;
    x[3] = times(u, conjugate(turn)) + times(v, turn) - third;
}

vec2 longest(vec2 a, vec2 b) { return dot(a, a) >= dot(b, b) ? a : b; }

// Ferrari with the longest root of the resolvent.
void complex_monic_quartic(vec2 a0, vec2 a1, vec2 a2, vec2 a3, out vec2 x[5]) {
    const vec2 shift = 0.25 * a3, square = times(shift, shift);
    const vec2 p = a2 - 6.0 * square;
    const vec2 q = a1 - 2.0 * times(a2, shift) + 8.0 * times(square, shift);
    const vec2 r = a0 - times(a1, shift) + times(a2, square) - 3.0 * times(square, square);
    vec2 resolvent[5];
    complex_monic_cubic(-times(q, q), times(p, p) - 4.0 * r, 2.0 * p, resolvent);
    const vec2 z = longest(resolvent[1], longest(resolvent[2], resolvent[3]));
    const vec2 root = square_root(z), middle = 0.25 * z - 0.5 * (p + z), gap = over(0.5 * q, root);
    const vec2 low = square_root(middle + gap), high = square_root(middle - gap);
    x[1] = -0.5 * root - low - shift;
    x[2] = -0.5 * root + low - shift;
    x[3] = 0.5 * root - high - shift;
    x[4] = 0.5 * root + high - shift;
}

// LDL^H of B[i][j] = b[i - j] with b[-k] the conjugate, solved for (1, u, u^2, ...).
void solve_toeplitz(vec2 b[5], vec2 u, out vec2 c[5]) {
    vec2 lower[5][5], y[5];
    float pivot[5];
    vec2 power = vec2(1.0, 0.0);
    for (uint i = 0u; i < order; ++i) {
        y[i] = power;
        power = times(power, u);
        float diagonal = b[0].x;
        for (uint j = 0u; j < i; ++j) {
            vec2 sum = b[i - j];
            for (uint k = 0u; k < j; ++k) sum -= times(lower[i][k], conjugate(lower[j][k])) * pivot[k];
            lower[i][j] = sum / pivot[j];
            diagonal -= dot(lower[i][j], sum);
            y[i] -= times(lower[i][j], y[j]);
        }
        pivot[i] = max(diagonal, least_pivot);
    }
    for (uint i = order; i-- > 0u;) {
        c[i] = y[i] / pivot[i];
        for (uint j = i + 1u; j < order; ++j) c[i] -= times(conjugate(lower[j][i]), c[j]);
    }
}

// On the circle: closed forms, a step of Newton's, and back to length 1.
void find_circle_nodes(vec2 c[5], vec2 u, out vec2 x[5]) {
    if (roots == 2u) complex_quadratic(c[0], c[1], c[2], x);
    else if (roots == 3u) complex_monic_cubic(over(c[0], c[3]), over(c[1], c[3]), over(c[2], c[3]), x);
    else complex_monic_quartic(over(c[0], c[4]), over(c[1], c[4]), over(c[2], c[4]), over(c[3], c[4]), x);
    for (uint i = 1u; i <= roots; ++i) {
        vec2 value = vec2(0.0), slope = vec2(0.0);
        for (uint k = order; k-- > 0u;) {
            slope = times(slope, x[i]) + value;
            value = times(value, x[i]) + c[k];
        }
        const vec2 step = over(value, slope);
        if (dot(step, step) < 0.01) x[i] -= step;
        x[i] /= max(length(x[i]), 1e-6);
    }
    x[0] = u;
}

// Grows from -1 to 7 once around the circle from angle 0: cheaper than an arc tangent, and sorts as well.
float around(vec2 u) {
    float r = abs(u.y) - abs(u.x);
    if (u.x < 0.0) r = 2.0 - r;
    return u.y < 0.0 ? 6.0 - r : r;
}

float circle_absorbance_before(vec2 b[5], float angle, float at_node) {
    const vec2 u = polar(angle);
    vec2 c[5], x[5], f[5];
    solve_toeplitz(b, u, c);
    for (uint i = 0u; i < order; ++i) c[i] = conjugate(c[i]);
    find_circle_nodes(c, u, x);
    // What is reconstructed inside the wrapping zone is in front of everything, more so towards its end.
    const float zone_begins = around(polar(2.0 * half_turn - wrapping_zone));
    f[0] = vec2(at_node, 0.0);
    for (uint i = 1u; i <= roots; ++i) {
        const float place = around(x[i]);
        f[i] = vec2((place < around(u) ? 1.0 : 0.0) + clamp((place - zone_begins) / (7.0 - zone_begins), 0.0, 1.0), 0.0);
    }
    for (uint k = 1u; k <= roots; ++k)
        for (uint i = roots; i >= k; --i) {
            const vec2 gap = x[i] - x[i - k];
            f[i] = dot(gap, gap) > 1e-14 ? over(f[i] - f[i - 1u], gap) : vec2(0.0);
        }
    vec2 q[5];
    for (uint k = 0u; k < 5u; ++k) q[k] = vec2(0.0);
    for (uint i = order; i-- > 0u;) {
        for (uint k = roots; k > 0u; --k) q[k] = q[k - 1u] - times(x[i], q[k]);
        q[0] = f[i] - times(x[i], q[0]);
    }
    float sum = 0.0;
    for (uint k = 0u; k < order; ++k) sum += times(q[k], b[k]).x;
    return sum;
}

#endif
