#include "passes/scene/fragment_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "passes/scene/view_space.h"

namespace strata {
namespace {

// Vertices are transformed in float (1e-6 of a coordinate) and snapped to 1/256 pixel; both stay far below this, in pixels.
constexpr double edge_margin = .25;

/// First and last pixel of a range in one direction that a polygon from `low` to `high` can touch; none where last < first.
struct PixelRange {
    PixelRange(double low, double high, std::uint32_t size)
        : first(static_cast<std::int64_t>(std::floor(std::clamp(low - edge_margin, 0., double(size))))),
          last(static_cast<std::int64_t>(std::floor(std::clamp(high + edge_margin, -1., size - 1.)))) {}
    std::int64_t first, last;
    std::uint64_t count() const { return last < first ? 0 : static_cast<std::uint64_t>(last - first) + 1; }
};

/// Rectangles over pixels, counted by their corners: a prefix sum in both directions makes them counts per pixel.
class Overlaps {
public:
    explicit Overlaps(Extent extent) : width_(extent.width + 1), corners_(std::size_t{width_} * (extent.height + 1), 0) {}

    void add(const PixelRange& x, const PixelRange& y) {
        if (x.count() == 0 || y.count() == 0) return;
        corner(x.first, y.first) += 1;
        corner(x.last + 1, y.first) -= 1;
        corner(x.first, y.last + 1) -= 1;
        corner(x.last + 1, y.last + 1) += 1;
    }

    std::uint64_t most() {
        for (std::size_t i = 1; i < corners_.size(); ++i)
            if (i % width_ != 0) corners_[i] += corners_[i - 1];
        for (std::size_t i = width_; i < corners_.size(); ++i) corners_[i] += corners_[i - width_];
        return static_cast<std::uint64_t>(std::ranges::max(corners_));
    }

private:
    std::int64_t& corner(std::int64_t x, std::int64_t y) {
        return corners_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)];
    }

    std::size_t width_;
    std::vector<std::int64_t> corners_;
};

/// Projects to pixels and adds what polygons touch to the rows.
class TouchedPixels {
public:
    TouchedPixels(const View& view, Extent extent) : view_(view), extent_(extent), rows_(extent.height, 0), overlaps_(extent) {}

    /// A convex polygon in view space.
    void add(std::span<const glm::dvec3> corners) {
        pixels_.clear();
        for (std::size_t i = 0; i < corners.size(); ++i) add_clipped(corners[i], corners[(i + 1) % corners.size()]);
        if (!pixels_.empty()) add_pixels();
    }

    FragmentBounds take() { return {std::move(rows_), overlaps_.most()}; }

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
        glm::dvec2 low = pixels_[0], high = low;
        for (const glm::dvec2& p : pixels_) low = glm::min(low, p), high = glm::max(high, p);
        const PixelRange columns(low.x, high.x, extent_.width), rows(low.y, high.y, extent_.height);
        overlaps_.add(columns, rows);
        for (std::int64_t y = rows.first; y <= rows.last; ++y)
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
        return PixelRange(low, high, extent_.width).count();
    }

    const View& view_;
    Extent extent_;
    std::vector<std::uint64_t> rows_;
    Overlaps overlaps_;
    std::vector<glm::dvec2> pixels_;
};

void add_draw(const Frame& frame, const Draw& draw, TouchedPixels& sum) {
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
void add_particle(const Frame& frame, const Particle& particle, TouchedPixels& sum) {
    const glm::dvec3 center = in_view_space(frame.view, particle.center);
    const double c = std::cos(double(particle.rotation)) * double(particle.size);
    const double s = std::sin(double(particle.rotation)) * double(particle.size);
    const glm::dvec3 u(c, s, 0), v(-s, c, 0);
    sum.add(std::array{center - u - v, center + u - v, center + u + v, center - u + v});
}

}  // namespace

FragmentBounds fragment_bounds(const Frame& frame, const DrawLists& lists, Extent extent) {
    TouchedPixels sum(frame.view, extent);
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

std::vector<RowBand> row_bands(std::span<const std::uint64_t> fragments_by_row, std::uint64_t limit) {
    std::vector<RowBand> bands{{}};
    for (std::size_t y = 0; y < fragments_by_row.size(); y += 2) {
        const std::uint32_t rows = y + 1 < fragments_by_row.size() ? 2 : 1;
        const std::uint64_t pair = fragments_by_row[y] + (rows == 2 ? fragments_by_row[y + 1] : 0);
        if (bands.back().rows > 0 && bands.back().bound + pair > limit)
            bands.push_back({.first_row = static_cast<std::uint32_t>(y)});
        bands.back().rows += rows;
        bands.back().bound += pair;
    }
    return bands;
}

}  // namespace strata
