#include "passes/indirect/reading_model.h"

#include <algorithm>
#include <cmath>

namespace strata::indirect::in_double {
namespace {

// docs/algorithms/lighting.md 5.8: the least sum of weights.
constexpr double least_weight = 0.02;

// docs/algorithms/lighting.md 5.8: the area of a unit cube seen from anywhere, in the mean.
constexpr double mean_section = 1.5;

/// The eight cells around a place, with weights that are 0 where a tap is hidden.
struct Taps {
    std::array<glm::ivec3, 8> cells;
    std::array<double, 8> weights;
    double sum = 0;
};

/// `cells` before the surface; below 0 behind it.
Taps taps_of(const LitGrid& lit, const Receiver& at, double cells) {
    const double size = lit.grid.cell_size;
    const glm::dvec3 place = in_cells(lit.grid, at.position + at.normal * (size * cells)) - 0.5, low = glm::floor(place);
    const glm::dvec3 part = place - low, start = way_begin(at.position, at.normal);
    Taps taps;
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::ivec3 step(i & 1, i >> 1 & 1, i >> 2);
        const glm::dvec3 w = glm::mix(1.0 - part, part, glm::dvec3(step));
        taps.cells[i] = glm::ivec3(low) + step;
        const Segment way{start, cell_middle(lit.grid, taps.cells[i])};
        taps.weights[i] = is_blocked(lit.tap_barriers, way, slack_of(size)) ? 0 : w.x * w.y * w.z;
        taps.sum += taps.weights[i];
    }
    return taps;
}

glm::dvec4 weighted(const Grid& grid, const Taps& taps, const Channel& channel) {
    if (taps.sum < least_weight) return glm::dvec4(0);
    glm::dvec4 sum(0);
    for (std::size_t i = 0; i < 8; ++i)
        if (is_inside(grid, taps.cells[i])) sum += taps.weights[i] * channel[cell_index(grid.cells, glm::uvec3(taps.cells[i]))];
    return sum / taps.sum;
}

/// W of a cell's light, or of a part of it that may be less than nothing, onto a square meter of a surface by a rule.
double received(const glm::dvec4& light, const glm::dvec3& normal, std::uint32_t rule) {
    // Cells hold what leaves them: what arrives at the surface travels against its normal.
    const double intensity = harmonic0 * light.x - harmonic1 * glm::dot(glm::dvec3(light.y, light.z, light.w), normal);
    return rule == irradiance_face ? 4 * intensity : glm::dot(cosine_lobe(-normal), light) / mean_section;
}

double share_by_facing(const LitGrid& lit, const Taps& taps, const glm::dvec3& normal) {
    glm::dvec4 all(0), alike(0);
    for (const Channel& channel : lit.light) all += weighted(lit.grid, taps, channel) / 3.0;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        alike += normal[axis] * (2.0 * weighted(lit.grid, taps, lit.facing[std::size_t(axis)]) - all);
    const double whole = received(all, normal, lit.irradiance);
    return whole > 0 ? std::clamp(1 - received(alike, normal, lit.irradiance) / whole, 0.0, 2.0) : 0;
}

}  // namespace

glm::dvec4 sampled(const LitGrid& lit, std::size_t channel, const Receiver& at) {
    return weighted(lit.grid, taps_of(lit, at, lit.reading), lit.light[channel]);
}

double share_by_facing(const LitGrid& lit, const Receiver& at) {
    return lit.facing[0].empty() ? 1 : share_by_facing(lit, taps_of(lit, at, lit.reading), at.normal);
}

double kept_share(const glm::dvec4& before, const glm::dvec4& behind, double k) {
    const glm::dvec4 change = before - behind;
    const double lengths = glm::length(before) * glm::length(change);
    const double cosine = lengths > 0 ? glm::dot(before, change) / lengths : 1;
    return std::pow(std::max(0.0, (1 + cosine) / 2), k);
}

glm::dvec3 irradiance(const LitGrid& lit, const Receiver& at) {
    const Taps taps = taps_of(lit, at, lit.reading);
    const double area = lit.grid.cell_size * lit.grid.cell_size;
    glm::dvec3 result;
    for (std::size_t channel = 0; channel < 3; ++channel)
        result[glm::length_t(channel)] =
            std::max(0.0, received(weighted(lit.grid, taps, lit.light[channel]), at.normal, lit.irradiance)) / area;
    if (!lit.facing[0].empty()) result *= share_by_facing(lit, taps, at.normal);
    if (lit.damping == 0) return result;
    const Taps behind = taps_of(lit, at, -0.5);
    for (std::size_t channel = 0; channel < 3; ++channel)
        result[glm::length_t(channel)] *=
            kept_share(weighted(lit.grid, taps, lit.light[channel]), weighted(lit.grid, behind, lit.light[channel]), lit.damping);
    return result;
}

double grid_share(const Grid& grid, const glm::dvec3& position) {
    const glm::dvec3 place = in_cells(grid, position), inside = glm::min(place, glm::dvec3(grid.cells) - place);
    return std::clamp(std::min({inside.x, inside.y, inside.z}) / grid.fade_cells, 0.0, 1.0);
}

glm::dvec3 blended_irradiance(std::span<const LitGrid> all, const Receiver& at) {
    return blended(all, at.position, [&](std::size_t i) { return irradiance(all[i], at); });
}

}  // namespace strata::indirect::in_double
