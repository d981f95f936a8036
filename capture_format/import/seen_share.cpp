// Triangles are tested in homogeneous coordinates, so that none of them has to be clipped: Olano and Greer, Triangle Scan
// Conversion using 2D Homogeneous Coordinates, 1997.
#include "capture_format/import/seen_share.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace strata {
namespace {

constexpr int columns = 64, rows = 36;

class Coverage {
public:
    /// Corners as x, y, w: a point is seen at x / w, y / w where w is above 0.
    void add(const std::array<glm::dvec3, 3>& corners) {
        const glm::dmat3 edges(glm::cross(corners[1], corners[2]), glm::cross(corners[2], corners[0]),
                               glm::cross(corners[0], corners[1]));
        const double volume = glm::dot(corners[0], edges[0]);
        if (volume == 0 || !std::isfinite(volume)) return;
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
                if (inside.x >= 0 && inside.y >= 0 && inside.z >= 0)
                    covered_[static_cast<std::size_t>(row * columns + column)] = true;
            }
    }

    double share() const {
        return static_cast<double>(std::count(covered_.begin(), covered_.end(), true)) / static_cast<double>(covered_.size());
    }

private:
    static int first(double low, int count) { return static_cast<int>(std::clamp((low + 1) / 2, 0.0, 1.0) * (count - 1)); }
    static int last(double high, int count) {
        return static_cast<int>(std::ceil(std::clamp((high + 1) / 2, 0.0, 1.0) * (count - 1)));
    }

    std::vector<bool> covered_ = std::vector<bool>(columns * rows);
};

}  // namespace

double seen_share(const Frame& frame) {
    Coverage coverage;
    const View& view = frame.view;
    for (const Draw& draw : frame.draws) {
        const Mesh& mesh = frame.meshes[draw.mesh];
        std::vector<glm::dvec3> points;
        for (const glm::vec3& position : mesh.positions) {
            const glm::dvec3 p = view.to_view * (glm::dvec3(draw.to_world * glm::dvec4(glm::dvec3(position), 1)) - view.origin);
            const glm::dvec4 clip = glm::dmat4(view.projection) * glm::dvec4(p, 1);
            points.emplace_back(clip.x, clip.y, clip.w);
        }
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            coverage.add({points[mesh.indices[i]], points[mesh.indices[i + 1]], points[mesh.indices[i + 2]]});
    }
    return coverage.share();
}

}  // namespace strata
