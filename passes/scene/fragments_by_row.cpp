#include "passes/scene/fragments_by_row.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "passes/scene/view_space.h"

namespace strata {
namespace {

// Vertices are transformed in float (1e-6 of a coordinate) and snapped to 1/256 pixel; both stay far below this, in pixels.
constexpr double edge_margin = .25;

/// Projects to pixels and adds what polygons touch to the rows.
class RowSum {
public:
    RowSum(const View& view, Extent extent) : view_(view), extent_(extent), rows_(extent.height, 0) {}

    /// A convex polygon in view space.
    void add(std::span<const glm::dvec3> corners) {
        pixels_.clear();
        for (std::size_t i = 0; i < corners.size(); ++i) add_clipped(corners[i], corners[(i + 1) % corners.size()]);
        if (!pixels_.empty()) add_pixels();
    }

    std::vector<std::uint64_t> take() { return std::move(rows_); }

private:
    /// The part of an edge in front of the near plane: its begin, and where it crosses the plane.
    void add_clipped(const glm::dvec3& a, const glm::dvec3& b) {
        const double near = double(view_.near) * .999;  // a little before the device's own clip
        if (a.z >= near) pixels_.push_back(projected(a));
        if ((a.z >= near) != (b.z >= near)) pixels_.push_back(projected(glm::mix(a, b, (near - a.z) / (b.z - a.z))));
    }

    glm::dvec2 projected(const glm::dvec3& p) const {
        const double x = double(view_.projection[0][0]) * p.x / p.z + double(view_.projection[2][0]) + double(view_.jitter.x);
        const double y = double(view_.projection[1][1]) * p.y / p.z + double(view_.projection[2][1]) + double(view_.jitter.y);
        return {(.5 + .5 * x) * extent_.width, (.5 + .5 * y) * extent_.height};
    }

    void add_pixels() {
        double low = pixels_[0].y, high = low;
        for (const glm::dvec2& p : pixels_) low = std::min(low, p.y), high = std::max(high, p.y);
        const auto first = static_cast<std::int64_t>(std::floor(std::clamp(low - edge_margin, 0., double(extent_.height))));
        const auto last = static_cast<std::int64_t>(std::floor(std::clamp(high + edge_margin, -1., extent_.height - 1.)));
        for (std::int64_t y = first; y <= last; ++y)
            rows_[static_cast<std::size_t>(y)] += touched(double(y) - edge_margin, double(y) + 1 + edge_margin);
    }

    /// Pixels of the row that the polygon can touch between two heights.
    std::uint64_t touched(double top, double bottom) const {
        double low = 1e300, high = -1e300;
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const glm::dvec2 a = pixels_[i], b = pixels_[(i + 1) % pixels_.size()];
            if (std::max(a.y, b.y) < top || std::min(a.y, b.y) > bottom) continue;
            for (const glm::dvec2 end : {a, b}) {
                const double y = std::clamp(end.y, top, bottom);
                const double x = y == end.y ? end.x : a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
                low = std::min(low, x), high = std::max(high, x);
            }
        }
        if (low > high) return 0;
        const double first = std::floor(std::clamp(low - edge_margin, 0., double(extent_.width)));
        const double last = std::floor(std::clamp(high + edge_margin, -1., extent_.width - 1.));
        return last < first ? 0 : static_cast<std::uint64_t>(last - first) + 1;
    }

    const View& view_;
    Extent extent_;
    std::vector<std::uint64_t> rows_;
    std::vector<glm::dvec2> pixels_;
};

void add_draw(const Frame& frame, const Draw& draw, RowSum& sum) {
    const Mesh& mesh = frame.meshes[draw.mesh];
    std::vector<glm::dvec3> positions;
    positions.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions)
        positions.push_back(in_view_space(frame.view, glm::dvec3(draw.to_world * glm::dvec4(glm::dvec3(p), 1))));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::array corners{positions[mesh.indices[i]], positions[mesh.indices[i + 1]], positions[mesh.indices[i + 2]]};
        sum.add(corners);
    }
}

/// The two triangles of a quad share no sample, so the quad counts once.
void add_particle(const Frame& frame, const Particle& particle, RowSum& sum) {
    const glm::dvec3 center = in_view_space(frame.view, particle.center);
    const double c = std::cos(double(particle.rotation)) * double(particle.size);
    const double s = std::sin(double(particle.rotation)) * double(particle.size);
    const glm::dvec3 u(c, s, 0), v(-s, c, 0);
    sum.add(std::array{center - u - v, center + u - v, center + u + v, center - u + v});
}

}  // namespace

std::vector<std::uint64_t> most_fragments_by_row(const Frame& frame, const DrawLists& lists, Extent extent) {
    RowSum sum(frame.view, extent);
    for (const std::uint32_t index : lists.transparent) {
        if (index < frame.draws.size()) {
            add_draw(frame, frame.draws[index], sum);
        } else {
            for (const Particle& particle : frame.emitters[index - frame.draws.size()].particles)
                add_particle(frame, particle, sum);
        }
    }
    return sum.take();
}

std::vector<RowBand> row_bands(std::span<const std::uint64_t> most_fragments_by_row, std::uint64_t limit) {
    std::vector<RowBand> bands{{}};
    for (std::size_t y = 0; y < most_fragments_by_row.size(); y += 2) {
        const std::uint32_t rows = y + 1 < most_fragments_by_row.size() ? 2 : 1;
        const std::uint64_t pair = most_fragments_by_row[y] + (rows == 2 ? most_fragments_by_row[y + 1] : 0);
        if (bands.back().rows > 0 && bands.back().bound + pair > limit)
            bands.push_back({.first_row = static_cast<std::uint32_t>(y)});
        bands.back().rows += rows;
        bands.back().bound += pair;
    }
    return bands;
}

}  // namespace strata
