#include "passes/indirect/lpv/propagation/propagation_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <tbb/parallel_for.h>

namespace strata::indirect::in_double {
namespace {

using std::numbers::pi;

const double lobe0 = std::sqrt(pi) / 2, lobe1 = std::sqrt(pi / 3);

/// Of the faces of the neighbor along d as the middle of the source cell sees them: solid angles, and the integrals of the
/// direction over them: far_along d for the far face, side_along d + side_out f for the side face towards f.
struct Faces {
    double far_angle, side_angle;
    double far_along, side_along, side_out;
};

/// The integral of the direction over the solid angle of a rectangle, corners in order around it: half the sum over the edges of
/// their angle times the normal of their plane through the origin (Lambert's formula for polygons).
glm::dvec3 direction_integral(const std::array<glm::dvec3, 4>& corners) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 4], normal = glm::cross(a, b);
        const double sine = glm::length(normal);
        sum += normal * (std::atan2(sine, glm::dot(a, b)) / sine);
    }
    return sum / 2.0;
}

/// docs/algorithms/lighting.md 5.4. The neighbor along z is the cube between z = 0.5 and z = 1.5.
Faces faces_of(uint rule) {
    const double far_angle = 4 * std::asin(0.1), side_angle = (2 * pi / 3 - far_angle) / 4;
    if (rule == faces_centre)
        return {far_angle, side_angle, far_angle, side_angle * 2 / std::sqrt(5.), side_angle / std::sqrt(5.)};
    const double h = 0.5, near = 0.5, far = 1.5;
    const glm::dvec3 far_face = direction_integral({{{-h, -h, far}, {h, -h, far}, {h, h, far}, {-h, h, far}}});
    const glm::dvec3 side = direction_integral({{{h, -h, near}, {h, h, near}, {h, h, far}, {h, -h, far}}});
    return {far_angle, side_angle, std::abs(far_face.z), std::abs(side.z), std::abs(side.x)};
}

const std::array<Faces, 2> both_faces = {faces_of(faces_centre), faces_of(faces_exact)};

/// Direction of the light that a side face takes: along the way, and out of the face. The middle of the source cell sees the
/// middle of the face one cell ahead and half a cell aside.
glm::dvec2 side_lobe(uint lobes) { return lobes == lobes_face ? glm::dvec2(0, 1) : glm::normalize(glm::dvec2(1, 0.5)); }

/// The sum over the five faces in closed form, where none is clamped.
glm::dvec4 arriving_linear(const glm::dvec4& source, const Travel& to, const Faces& faces, const glm::dvec2& lobe) {
    const double l0 = source.x, along = to.sign * source[to.axis + 1];
    const double far = faces.far_angle * harmonic0 * l0 + faces.far_along * harmonic1 * along;
    const double sides = 4 * (faces.side_angle * harmonic0 * l0 + faces.side_along * harmonic1 * along);
    // Opposite side faces differ by what the light across the way gives them.
    glm::dvec4 result = source * (2 * faces.side_out * lobe.y * harmonic1 * lobe1 / pi);
    result.x = (far + sides) * lobe0 / pi;
    result[to.axis + 1] = to.sign * (far + lobe.x * sides) * lobe1 / pi;
    return result;
}

/// Fluxes through the far face and through the four side faces: towards -, + of the next axis, and -, + of the one after.
std::array<double, 5> clamped_fluxes(const glm::dvec4& source, const Travel& to, const Faces& faces) {
    const double l0 = source.x, along = to.sign * source[to.axis + 1];
    const double side = faces.side_angle * harmonic0 * l0 + faces.side_along * harmonic1 * along;
    const double first = faces.side_out * harmonic1 * source[(to.axis + 1) % 3 + 1];
    const double second = faces.side_out * harmonic1 * source[(to.axis + 2) % 3 + 1];
    std::array<double, 5> fluxes = {faces.far_angle * harmonic0 * l0 + faces.far_along * harmonic1 * along, side - first,
                                    side + first, side - second, side + second};
    for (double& flux : fluxes) flux = std::max(flux, 0.0);
    return fluxes;
}

glm::dvec4 arriving_clamped(const glm::dvec4& source, const Travel& to, const Faces& faces, const glm::dvec2& lobe) {
    const auto [far, first_low, first_high, second_low, second_high] = clamped_fluxes(source, to, faces);
    const double sides = (first_low + first_high) + (second_low + second_high);
    glm::dvec4 result;
    result.x = (far + sides) * lobe0 / pi;
    result[to.axis + 1] = to.sign * (far + lobe.x * sides) * lobe1 / pi;
    result[(to.axis + 1) % 3 + 1] = lobe.y * (first_high - first_low) * lobe1 / pi;
    result[(to.axis + 2) % 3 + 1] = lobe.y * (second_high - second_low) * lobe1 / pi;
    return result;
}

/// Everything one step reads.
struct Step {
    const Links& links;
    const Channel& light;
    std::span<const double> shares;  ///< sent_share() of each cell, or empty
    PropagationRule rule;
};

glm::dvec4 received(const Step& step, const glm::uvec3& cell) {
    const glm::uvec3& cells = step.links.cells;
    const std::size_t here = cell_index(cells, cell);
    glm::dvec4 sum(0);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        for (const double sign : {1., -1.}) {
            if (sign > 0 ? cell[axis] == 0 : cell[axis] + 1 == cells[axis]) continue;
            glm::uvec3 source = cell;
            source[axis] = sign > 0 ? cell[axis] - 1 : cell[axis] + 1;
            const std::size_t there = cell_index(cells, source);
            const glm::dvec4& light = step.light[there];
            const double open = step.links.open.empty() ? 1 : step.links.open[sign > 0 ? there : here][axis];
            if (open == 0 || light == glm::dvec4(0)) continue;
            const double share = step.shares.empty() ? open : open * step.shares[there];
            sum += share * arriving(light, {axis, sign}, step.rule);
        }
    return sum;
}

}  // namespace

glm::dvec4 arriving(const glm::dvec4& source, const Travel& to, const PropagationRule& rule) {
    const Faces& faces = both_faces[rule.faces];
    const glm::dvec2 lobe = side_lobe(rule.lobes);
    return rule.propagation == propagation_linear ? arriving_linear(source, to, faces, lobe)
                                                  : arriving_clamped(source, to, faces, lobe);
}

double sent_share(const glm::dvec4& source, const PropagationRule& rule) {
    if (rule.propagation != propagation_energy_true) return 1;
    double sum = 0;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        for (const double sign : {1., -1.})
            for (const double flux : clamped_fluxes(source, {axis, sign}, both_faces[rule.faces])) sum += flux;
    return sum > 0 ? 2 * std::sqrt(pi) * source.x / sum : 0;
}

Channel next_step(const Links& links, const Channel& light, const PropagationRule& rule) {
    std::vector<double> shares;
    if (rule.propagation == propagation_energy_true) {
        shares.resize(light.size());
        std::ranges::transform(light, shares.begin(), [&](const glm::dvec4& source) { return sent_share(source, rule); });
    }
    const Step step{links, light, shares, rule};
    Channel next(light.size());
    tbb::parallel_for(0u, links.cells.z, [&](std::uint32_t z) {
        for (std::uint32_t y = 0; y < links.cells.y; ++y)
            for (std::uint32_t x = 0; x < links.cells.x; ++x)
                next[cell_index(links.cells, {x, y, z})] = received(step, {x, y, z});
    });
    return next;
}

Channel propagated(const Links& links, const Channel& injected, const PropagationRule& rule, std::uint32_t iterations) {
    Channel sum = injected, light = injected;
    for (std::uint32_t i = 0; i < iterations; ++i) {
        light = next_step(links, light, rule);
        for (std::size_t cell = 0; cell < sum.size(); ++cell) sum[cell] += light[cell];
    }
    return sum;
}

}  // namespace strata::indirect::in_double
