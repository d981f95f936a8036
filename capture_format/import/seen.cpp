// Triangles are tested in homogeneous coordinates, so that none of them has to be clipped: Olano and Greer, Triangle Scan
// Conversion using 2D Homogeneous Coordinates, 1997.
#include "capture_format/import/seen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"

namespace strata {
namespace {

constexpr int columns = 64, rows = 36;

class Depths {
public:
    /// Corners as x, y, w: a point is seen at x / w, y / w where w is above 0.
    void add(const std::array<glm::dvec3, 3>& corners) {
        const glm::dmat3 edges(glm::cross(corners[1], corners[2]), glm::cross(corners[2], corners[0]),
                               glm::cross(corners[0], corners[1]));
        const double volume = glm::dot(corners[0], edges[0]);
        if (volume == 0 || !std::isfinite(volume)) return;
        if (std::max({corners[0].z, corners[1].z, corners[2].z}) <= 0) return;  // behind the eye
        glm::dvec2 low(-1), high(1);
        if (std::min({corners[0].z, corners[1].z, corners[2].z}) > 0) {
            low = high = glm::dvec2(corners[0]) / corners[0].z;
            for (const glm::dvec3& corner : corners) {
                low = glm::min(low, glm::dvec2(corner) / corner.z);
                high = glm::max(high, glm::dvec2(corner) / corner.z);
            }
        }
        const int left = first(low.x, columns), right = last(high.x, columns), top = first(low.y, rows),
                  bottom = last(high.y, rows);
        for (int row = top; row <= bottom; ++row)
            for (int column = left; column <= right; ++column) {
                const glm::dvec3 at((column + 0.5) * 2 / columns - 1, (row + 0.5) * 2 / rows - 1, 1);
                const glm::dvec3 inside = at * edges / volume;  // each at least 0 within, their sum 1 / w
                const double inverse = inside.x + inside.y + inside.z;
                if (!(inside.x >= 0 && inside.y >= 0 && inside.z >= 0 && inverse > 0)) continue;
                double& nearest = nearest_[static_cast<std::size_t>(row * columns + column)];
                if (nearest == 0 || 1 / inverse < nearest) nearest = 1 / inverse;
            }
    }

    std::vector<double> take() { return std::move(nearest_); }

private:
    static int first(double low, int count) { return static_cast<int>(std::clamp((low + 1) / 2, 0.0, 1.0) * (count - 1)); }
    static int last(double high, int count) {
        return static_cast<int>(std::ceil(std::clamp((high + 1) / 2, 0.0, 1.0) * (count - 1)));
    }

    std::vector<double> nearest_ = std::vector<double>(columns * rows);
};

}  // namespace

std::vector<WorldTriangle> world_triangles(const Frame& frame) {
    std::vector<WorldTriangle> triangles;
    for (const Draw& draw : frame.draws) {
        const Mesh& mesh = frame.meshes[draw.mesh];
        const auto placed = [&](std::size_t i) {
            return glm::dvec3(draw.to_world * glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[i]]), 1));
        };
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) triangles.push_back({placed(i), placed(i + 1), placed(i + 2)});
    }
    return triangles;
}

std::vector<double> nearest_depths(const std::vector<WorldTriangle>& triangles, const View& view) {
    Depths depths;
    const glm::dmat4 projection(view.projection);
    const auto seen = [&](const glm::dvec3& point) {
        const glm::dvec4 clip = projection * glm::dvec4(view.to_view * (point - view.origin), 1);
        return glm::dvec3(clip.x, clip.y, clip.w);
    };
    for (const WorldTriangle& triangle : triangles) depths.add({seen(triangle[0]), seen(triangle[1]), seen(triangle[2])});
    return depths.take();
}

double seen_share(const Frame& frame) {
    const std::vector<double> depths = nearest_depths(world_triangles(frame), frame.view);
    const auto empty = std::count(depths.begin(), depths.end(), 0.0);
    return 1 - static_cast<double>(empty) / static_cast<double>(depths.size());
}

}  // namespace strata
