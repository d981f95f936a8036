#include "passes/indirect/lpv/injection/injection_model.h"

#include <algorithm>
#include <numbers>
#include <vector>

namespace strata::indirect::in_double {
namespace {

// Meters by which lights are moved on along their normals, so that a wall whose lights fall onto a border between cells gives
// them all to the cells beyond it (docs/algorithms/lighting.md 5.3).
constexpr double across_border = 1e-4;

/// +x -x +y -y +z -z of a cell, those whose middles are nearest to a place within it first. The place is relative to the middle.
std::array<glm::ivec3, 6> neighbors_by_distance(const glm::ivec3& cell, const glm::dvec3& place) {
    std::array<glm::ivec3, 6> ways;
    for (glm::length_t i = 0; i < 6; ++i) {
        ways[std::size_t(i)] = glm::ivec3(0);
        ways[std::size_t(i)][i / 2] = i % 2 == 0 ? 1 : -1;
    }
    // The squared distance is that to the cell's own middle, plus 1, minus twice this: equal ones stay equal.
    std::ranges::stable_sort(ways, std::greater{}, [&](const glm::ivec3& way) { return glm::dot(glm::dvec3(way), place); });
    for (glm::ivec3& way : ways) way += cell;
    return ways;
}

}  // namespace

std::optional<glm::uvec3> receiving_cell(const Grid& grid, const VirtualLight& light, const InjectionRule& rule) {
    if (light.is_behind_blocker && !rule.barriers.empty()) return std::nullopt;
    const double size = grid.cell_size;
    const glm::dvec3 biased = light.position + light.normal * (rule.bias * size);
    const glm::ivec3 first = cell_at(grid, biased + light.normal * across_border);
    if (!is_inside(grid, first)) return std::nullopt;
    const glm::dvec3 start = way_begin(light.position, light.normal);
    const auto takes = [&](const glm::ivec3& cell) {
        return is_inside(grid, cell) && !is_blocked(rule.barriers, {start, cell_middle(grid, cell)}, slack_of(size));
    };
    if (takes(first)) return glm::uvec3(first);
    const glm::ivec3 ahead = cell_at(grid, light.position + light.normal * (size + across_border));
    if (takes(ahead)) return glm::uvec3(ahead);
    for (const glm::ivec3& cell : neighbors_by_distance(first, in_cells(grid, biased) - glm::dvec3(first) - 0.5))
        if (takes(cell)) return glm::uvec3(cell);
    return std::nullopt;
}

std::vector<VirtualLight> by_facing(std::vector<VirtualLight> lights) {
    for (VirtualLight& light : lights) light.flux = (light.flux.x + light.flux.y + light.flux.z) / 3 * (1.0 + light.normal) / 2.0;
    return lights;
}

Field injected(const Grid& grid, std::span<const VirtualLight> lights, const InjectionRule& rule) {
    Field field;
    field.fill(Channel(cell_count(grid), glm::dvec4(0)));
    for (const VirtualLight& light : lights) {
        const std::optional<glm::uvec3> cell = receiving_cell(grid, light, rule);
        if (!cell) continue;
        const glm::dvec4 lobe = cosine_lobe(light.normal);
        for (std::size_t channel = 0; channel < field.size(); ++channel)
            field[channel][cell_index(grid.cells, *cell)] += lobe * (light.flux[glm::length_t(channel)] / std::numbers::pi);
    }
    return field;
}

}  // namespace strata::indirect::in_double
