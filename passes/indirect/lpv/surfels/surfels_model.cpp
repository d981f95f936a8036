#include "passes/indirect/lpv/surfels/surfels_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/reference/fragments.h"
#include "passes/reference/surfaces.h"
#include "passes/reference/triangles.h"

namespace strata::indirect::in_double {
namespace {

/// The lines along an axis through a grid and its margin, one per texel.
struct Lines {
    const Grid& grid;
    glm::length_t axis, u, v;
    double texel;  ///< meters
    glm::dvec3 corner, end;

    Lines(const Grid& through, glm::length_t along)
        : grid(through), axis(along), u((along + 1) % 3), v((along + 2) % 3), texel(through.cell_size / surfels_a_side) {
        corner = grid.origin - double(surfel_margin) * grid.cell_size;
        end = grid.origin + (glm::dvec3(grid.cells) + double(surfel_margin)) * grid.cell_size;
    }
    glm::dvec2 flat(const glm::dvec3& place) const { return {place[u], place[v]}; }
    glm::ivec2 count() const { return glm::ivec2(glm::round((flat(end) - flat(corner)) / texel)); }
    glm::dvec2 at(const glm::ivec2& line) const {
        return flat(corner) + (glm::dvec2(line) + 0.5 + glm::dvec2(surfel_shift_u, surfel_shift_v)) * texel;
    }
};

/// Shares of a triangle's corners at a place in the plane, if it lies within.
std::optional<glm::dvec3> shares(const std::array<glm::dvec2, 3>& corners, const glm::dvec2& place) {
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    const double area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (area == 0) return std::nullopt;
    const glm::dvec3 parts(cross(corners[1] - place, corners[2] - place), cross(corners[2] - place, corners[0] - place),
                           cross(corners[0] - place, corners[1] - place));
    const glm::dvec3 result = parts / area;
    if (std::min({result.x, result.y, result.z}) < 0) return std::nullopt;
    return result;
}

class Surfaces {
public:
    Surfaces(const Frame& frame, std::uint32_t draw) : frame_(frame), draw_(draw), space_(draw_space(frame, draw)) {}

    /// Adds what the lines meet of a triangle.
    void meet(const Lines& lines, std::uint32_t triangle, std::vector<Surfel>& found) const {
        const Corners in_view = view_corners(frame_, space_, draw_, triangle);
        Corners world;
        std::ranges::transform(in_view, world.begin(), [&](const glm::dvec3& p) { return in_world(p) + frame_.view.origin; });
        const glm::dvec3 across = glm::cross(in_view[1] - in_view[0], in_view[2] - in_view[0]);
        if (glm::dot(across, across) == 0) return;
        const glm::dvec3 flat_normal = in_world(space_.handedness * glm::normalize(across));
        const std::array<glm::dvec2, 3> flat = {lines.flat(world[0]), lines.flat(world[1]), lines.flat(world[2])};
        const glm::dvec2 low = glm::min(glm::min(flat[0], flat[1]), flat[2]),
                         high = glm::max(glm::max(flat[0], flat[1]), flat[2]);
        const auto line_at = [&](const glm::dvec2& place) {
            return glm::ivec2(glm::clamp((place - lines.at({0, 0})) / lines.texel, -1., 1e6));
        };
        const glm::ivec2 first = glm::max(line_at(low), 0), last = glm::min(line_at(high) + 1, lines.count() - 1);
        for (int j = first.y; j <= last.y; ++j)
            for (int i = first.x; i <= last.x; ++i)
                if (const auto at = shares(flat, lines.at({i, j})))
                    if (const auto surfel = surfel_at(lines, triangle, world, *at, flat_normal)) found.push_back(*surfel);
    }

private:
    glm::dvec3 in_world(const glm::dvec3& way) const { return glm::transpose(frame_.view.to_view) * way; }

    std::optional<Surfel> surfel_at(const Lines& lines, std::uint32_t triangle, const Corners& world, const glm::dvec3& at,
                                    const glm::dvec3& flat_normal) const {
        Surfel surfel;
        surfel.position = at.x * world[0] + at.y * world[1] + at.z * world[2];
        const double along = surfel.position[lines.axis];
        if (along < lines.corner[lines.axis] || along > lines.end[lines.axis]) return std::nullopt;
        const Material& material = frame_.materials[frame_.draws[draw_].material];
        if (material.alpha_mode == AlphaMode::mask && !reaches_cutoff(alpha_at(frame_, draw_, triangle, at), material))
            return std::nullopt;
        const Attributes attributes = attributes_at(frame_, draw_, triangle, at);
        const glm::dvec3 smooth = in_world(space_.normals * attributes.normal);
        surfel.normal = glm::dot(smooth, smooth) > 0 ? glm::normalize(smooth) : flat_normal;
        surfel.direction = flat_normal;
        surfel.area = lines.texel * lines.texel * std::abs(flat_normal[lines.axis]);
        surfel.albedo = glm::min(diffuse_albedo(frame_, draw_, attributes), 1.0);
        surfel.has_two_sides = material.double_sided;
        return surfel;
    }

    const Frame& frame_;
    std::uint32_t draw_;
    DrawSpace space_;
};

}  // namespace

std::vector<Surfel> surfels(const Frame& frame, const Grid& grid) {
    std::vector<Surfel> found;
    for (const std::uint32_t draw : opaque_draws(frame)) {
        const Surfaces surfaces(frame, draw);
        for (std::uint32_t triangle = 0; triangle < triangle_count(frame, draw); ++triangle)
            for (glm::length_t axis = 0; axis < 3; ++axis) surfaces.meet(Lines(grid, axis), triangle, found);
    }
    return found;
}

}  // namespace strata::indirect::in_double
