// Writes passes/reference/ltc_table.inc: for every roughness and angle of the eye the linearly transformed cosine that is nearest
// to the GGX lobe times its cosine. After Heitz, Dupuy, Hill, Neubelt 2016, section 4, but for two things. What is minimized is
// the integral of |difference|: no emitter of one radiance, whatever its shape, is off by more than half of that. And the lobe's
// own axis is free, where they keep it at the mean direction: at roughness .5 and 53 degrees that leaves half of the difference.
// The search is the simplex of Nelder and Mead 1965.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

#include "passes/reference/brdf.h"
#include "passes/shaders/ltc.shared.h"

namespace strata {
namespace {

using glm::dvec3;
constexpr double pi = std::numbers::pi;
// The last column's eye: at 0 there is no lobe.
constexpr double smallest_fitted_cosine = 1e-3;

/// GGX with Fresnel 1, seen by an eye in the xz plane; the normal is +z.
struct Lobe {
    double alpha;
    dvec3 eye;

    static double smith(double alpha, double cosine) {
        return std::sqrt(cosine * cosine + alpha * alpha * (1 - cosine * cosine));
    }
    double distribution(const dvec3& h) const {
        const double rest = h.z * h.z * (alpha * alpha - 1) + 1;
        return alpha * alpha / (pi * rest * rest);
    }
    /// f(l, eye) times the cosine of l.
    double at(const dvec3& l) const {
        if (l.z <= 0) return 0;
        const double visibility = 0.5 / (l.z * smith(alpha, eye.z) + eye.z * smith(alpha, l.z));
        return distribution(glm::normalize(l + eye)) * visibility * l.z;
    }
    /// G2 / G1(eye): what a direction drawn by visible normals weighs.
    double weight(const dvec3& l) const {
        if (l.z <= 0) return 0;
        const double to_eye = smith(alpha, eye.z), to_light = smith(alpha, l.z);
        return l.z * (eye.z + to_eye) / (l.z * to_eye + eye.z * to_light);
    }
    double density(const dvec3& l) const {
        if (l.z <= 0) return 0;
        // D G1 max(eye.h) / (eye.z 4 eye.h), G1 = 2 eye.z / (eye.z + smith).
        return distribution(glm::normalize(l + eye)) * 0.5 / (eye.z + smith(alpha, eye.z));
    }
    /// A direction from a visible normal (Heitz 2018), u in 0..1.
    dvec3 draw(double u, double v) const {
        const dvec3 stretched = glm::normalize(dvec3(alpha * eye.x, alpha * eye.y, eye.z));
        const double across = std::hypot(stretched.x, stretched.y);
        const dvec3 t = across > 1e-9 ? dvec3(-stretched.y, stretched.x, 0) / across : dvec3(1, 0, 0);
        const dvec3 b = glm::cross(stretched, t);
        const double r = std::sqrt(u), angle = 2 * pi * v, x = r * std::cos(angle), s = 0.5 * (1 + stretched.z);
        const double y = (1 - s) * std::sqrt(std::max(0.0, 1 - x * x)) + s * r * std::sin(angle);
        const dvec3 n = x * t + y * b + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * stretched;
        const dvec3 h = glm::normalize(dvec3(alpha * n.x, alpha * n.y, std::max(1e-12, n.z)));
        return glm::reflect(-eye, h);
    }
};

/// A cosine lobe bent in its own frame, which is then turned around y: logarithms of its widths, its shear, the angle.
using Shape = std::array<double, 4>;

glm::dmat3 matrix(const Shape& shape) {
    const dvec3 axis(std::sin(shape[3]), 0, std::cos(shape[3])), across(axis.z, 0, -axis.x);
    return {std::exp(shape[0]) * across, dvec3(0, std::exp(shape[1]), 0), shape[2] * across + axis};
}

struct Bent {
    glm::dmat3 forward, inverse;
    double determinant;

    explicit Bent(const glm::dmat3& m) : forward(m), inverse(glm::inverse(m)), determinant(std::abs(glm::determinant(m))) {}
    double at(const dvec3& l) const {
        const dvec3 back = inverse * l;
        const double length = glm::length(back), cosine = std::max(0.0, back.z / length);
        return cosine / (pi * determinant * length * length * length);
    }
    dvec3 draw(double u, double v) const {
        const double r = std::sqrt(u), angle = 2 * pi * v;
        return glm::normalize(forward * dvec3(r * std::cos(angle), r * std::sin(angle), std::sqrt(1 - u)));
    }
};

struct Moments {
    double albedo = 0, fresnel = 0;
};

Moments moments(const Lobe& lobe) {
    constexpr int steps = 512;
    Moments sum;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const dvec3 l = lobe.draw((i + 0.5) / steps, (j + 0.5) / steps);
            const double weight = lobe.weight(l) / (double(steps) * steps);
            sum.albedo += weight;
            sum.fresnel += weight * std::pow(1 - std::clamp(glm::dot(l, glm::normalize(l + lobe.eye)), 0.0, 1.0), 5);
        }
    return sum;
}

/// The integral of |difference| over the albedo, by directions drawn from both lobes.
class Misfit {
public:
    Misfit(const Lobe& lobe, double albedo) : lobe_(lobe), albedo_(albedo) {
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) {
                const dvec3 l = lobe.draw((i + 0.5) / steps, (j + 0.5) / steps);
                if (l.z > 0) drawn_.push_back(l);
            }
    }
    double operator()(const Shape& shape) const {
        const Bent bent(matrix(shape));
        double sum = 0;
        for (const dvec3& l : drawn_) sum += term(bent, l);
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) sum += term(bent, bent.draw((i + 0.5) / steps, (j + 0.5) / steps));
        return sum / (double(steps) * steps * albedo_);
    }

private:
    static constexpr int steps = 32;
    double term(const Bent& bent, const dvec3& l) const {
        const double fitted = bent.at(l), density = lobe_.density(l) + fitted;
        return density > 0 ? std::abs(lobe_.at(l) - albedo_ * fitted) / density : 0;
    }
    Lobe lobe_;
    double albedo_;
    std::vector<dvec3> drawn_;
};

/// The downhill simplex; reflection 1, expansion 2, contraction and shrinking 1/2.
template <typename Function>
Shape minimized(const Shape& start, double size, const Function& f) {
    struct Vertex {
        Shape at;
        double value;
    };
    constexpr std::size_t n = std::tuple_size_v<Shape>;
    const auto vertex = [&](const Shape& p) { return Vertex{p, f(p)}; };
    std::array<Vertex, n + 1> simplex;
    for (std::size_t i = 0; i <= n; ++i) {
        Shape p = start;
        if (i > 0) p[i - 1] += size;
        simplex[i] = vertex(p);
    }
    const auto along = [&](double t) {
        Shape p{};
        for (std::size_t k = 0; k < n; ++k) {
            double center = 0;
            for (std::size_t i = 0; i < n; ++i) center += simplex[i].at[k] / n;
            p[k] = center + t * (simplex[n].at[k] - center);
        }
        return vertex(p);
    };
    for (int step = 0; step < 300; ++step) {
        std::ranges::sort(simplex, {}, &Vertex::value);
        if (simplex[n].value - simplex[0].value <= 1e-6 * simplex[0].value) break;
        Vertex next = along(-1);
        if (next.value < simplex[0].value) {
            if (const Vertex further = along(-2); further.value < next.value) next = further;
        } else if (next.value >= simplex[n - 1].value) {
            next = along(next.value < simplex[n].value ? -0.5 : 0.5);
        }
        if (next.value < simplex[n].value) {
            simplex[n] = next;
            continue;
        }
        for (std::size_t i = 1; i <= n; ++i) {
            for (std::size_t k = 0; k < n; ++k) simplex[i].at[k] = 0.5 * (simplex[i].at[k] + simplex[0].at[k]);
            simplex[i] = vertex(simplex[i].at);
        }
    }
    return std::ranges::min(simplex, {}, &Vertex::value).at;
}

/// The fit of one cell, from its neighbors'. Straight above, the lobe is round: one number instead of four.
Shape fitted(const Lobe& lobe, double albedo, const std::vector<Shape>& starts) {
    const bool round = lobe.eye.x == 0;
    const Misfit misfit(lobe, albedo);
    const auto shape = [&](const Shape& p) { return round ? Shape{p[0], p[0], 0, 0} : p; };
    const auto value = [&](const Shape& p) { return misfit(shape(p)); };
    Shape best = starts.front();
    for (const Shape& start : starts) {
        // A second simplex around the first one's end finds the way on where that has shrunk too early.
        Shape found = start;
        for (const double size : {0.3, 0.1}) found = minimized(found, size, value);
        if (value(found) < value(best)) best = found;
    }
    return shape(best);
}

Lobe lobe_of(std::uint32_t row, std::uint32_t column) {
    const double roughness = double(row) / (ltc_edge - 1), s = double(column) / (ltc_edge - 1);
    const double cosine = std::max(1 - s * s, smallest_fitted_cosine);
    return {std::max(roughness * roughness, smallest_lobe), dvec3(std::sqrt(1 - cosine * cosine), 0, cosine)};
}

void write_table() {
    std::puts("// Written by fit_ltc. m11, m13, m22, m31, m33, albedo, fresnel; 32 columns of the eye's cosine per roughness.");
    std::array<Shape, ltc_edge> above;
    std::vector<std::array<LtcRecord, ltc_edge>> rows(ltc_edge);
    // From rough, where every start leads to the solution, to smooth.
    for (std::uint32_t row = ltc_edge; row-- > 0;) {
        double worst = 0;
        std::vector<Shape> starts = {Shape{}};
        for (std::uint32_t column = 0; column < ltc_edge; ++column) {
            const Lobe lobe = lobe_of(row, column);
            const Moments m = moments(lobe);
            if (row + 1 < ltc_edge) starts.push_back(above[column]);
            const Shape shape = above[column] = fitted(lobe, m.albedo, starts);
            starts = {shape};
            worst = std::max(worst, Misfit(lobe, m.albedo)(shape));
            // Its scale means nothing, but neighbors are mixed: so that directions are, the axis is a unit vector.
            const glm::dmat3 unscaled = matrix(shape);
            const glm::mat3 bent(unscaled * (1 / glm::length(unscaled[2])));
            rows[row][column] = {bent[0][0], bent[2][0], bent[1][1], bent[0][2], bent[2][2], float(m.albedo), float(m.fresnel)};
        }
        std::fprintf(stderr, "roughness %.3f: the worst column is off by %.3f of its albedo\n", double(row) / (ltc_edge - 1),
                     worst);
    }
    for (const auto& row : rows)
        for (const LtcRecord& r : row)
            std::printf("{%.7ef, %.7ef, %.7ef, %.7ef, %.7ef, %.7ef, %.7ef},\n", double(r.m11), double(r.m13), double(r.m22),
                        double(r.m31), double(r.m33), double(r.albedo), double(r.fresnel));
}

}  // namespace
}  // namespace strata

int main() { strata::write_table(); }
