// Meshes put together from parts. Texture coordinates are meters, so a texture has one size on all parts of a thing; on boxes and
// quads they are places in the mesh's own space, so a texture goes on from part to part.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "capture_format/frame/mesh.h"

namespace strata::scenario::part {

/// Lower left, lower right, upper right, upper left, seen from the front.
using Corners = std::array<glm::vec3, 4>;

/// A flat parallelogram.
void quad(Mesh&, const Corners&);
void box(Mesh&, glm::vec3 low, glm::vec3 high);
/// A bar of rectangular section: `half` is half its width, to the side and upwards. u runs along it.
void beam(Mesh&, glm::vec3 from, glm::vec3 to, glm::vec2 half);
/// A round tube without ends along a line of points.
void pipe(Mesh&, std::span<const glm::vec3> line, float radius, std::uint32_t sides);
/// A profile (distance from the axis, height) turned around the vertical axis through `foot`. Its outside lies to the left of the
/// way along it: downwards on the outside, outwards on the top. Bends below 50 degrees are smooth.
void turned(Mesh&, std::span<const glm::vec2> profile, glm::vec3 foot, std::uint32_t segments);
/// A sphere, or an ellipsoid around the y axis; `radii` are the horizontal and the vertical one.
void ball(Mesh&, glm::vec3 center, glm::vec2 radii, std::uint32_t segments);
/// A sheet over a grid of `cells`, both sides visible with a double-sided material. `at` maps (0..1, 0..1) to places; its front
/// is where the first axis is to the right and the second points up.
template <typename At>
void sheet(Mesh& mesh, glm::uvec2 cells, glm::vec2 meters, const At& at) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec2 step = 1.0f / glm::vec2(cells);
    for (std::uint32_t y = 0; y <= cells.y; ++y)
        for (std::uint32_t x = 0; x <= cells.x; ++x) {
            const glm::vec2 t = glm::vec2(x, y) * step;
            const glm::vec3 right = at(t + glm::vec2(0.01f, 0)) - at(t - glm::vec2(0.01f, 0));
            const glm::vec3 up = at(t + glm::vec2(0, 0.01f)) - at(t - glm::vec2(0, 0.01f));
            mesh.positions.push_back(at(t));
            mesh.normals.push_back(glm::normalize(glm::cross(right, up)));
            mesh.tangents.emplace_back(glm::normalize(right), 1.0f);
            mesh.uv0.emplace_back(t.x * meters.x, (1 - t.y) * meters.y);
        }
    for (std::uint32_t y = 0; y < cells.y; ++y)
        for (std::uint32_t x = 0; x < cells.x; ++x) {
            const std::uint32_t corner = first + y * (cells.x + 1) + x, above = corner + cells.x + 1;
            mesh.indices.insert(mesh.indices.end(), {corner, corner + 1, above + 1, corner, above + 1, above});
        }
}

}  // namespace strata::scenario::part
