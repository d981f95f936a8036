#include "passes/scene/fragment_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "passes/scene/view_space.h"

namespace strata {
namespace {

// Corners are snapped to a grid of 1/16 pixel or finer (subPixelPrecisionBits is 4 or more).
constexpr double snapping = 1. / 16;
// A sum of four products in float, of numbers that were rounded to float before: relative to the largest of them.
constexpr double rounding = 0x1p-21;

/// Where samples of a pixel may lie in it, each way: a single one in the middle, of several anywhere, because devices differ.
struct Places {
    double first, last;
};
Places places(std::uint32_t samples) { return samples == 1 ? Places{.5, .5} : Places{0, 1}; }

/// First and last pixel in one direction of those that can have a sample from `low` to `high`; none where last < first.
struct PixelRange {
    PixelRange(double low, double high, Places places, std::uint32_t size)
        : first(static_cast<std::int64_t>(std::ceil(std::clamp(low - places.last, 0., double(size))))),
          last(static_cast<std::int64_t>(std::floor(std::clamp(high - places.first, -1., size - 1.)))) {}
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

/// The corner of a polygon in view space, and how far off a device may see it, in meters.
struct Corner {
    glm::dvec3 position;
    double error;
};

/// Projects to pixels and adds what polygons touch to the rows.
class TouchedSamples {
public:
    TouchedSamples(const View& view, Extent extent, std::uint32_t samples)
        : view_(view), extent_(extent), samples_(samples), places_(places(samples)), rows_(extent.height, 0), overlaps_(extent) {}

    /// A convex polygon.
    void add(std::span<const Corner> corners) {
        pixels_.clear();
        margin_ = 0;
        for (std::size_t i = 0; i < corners.size(); ++i) add_clipped(corners[i], corners[(i + 1) % corners.size()]);
        if (!pixels_.empty()) add_pixels();
    }

    FragmentBounds take() { return {std::move(rows_), overlaps_.most()}; }

private:
    /// The part of an edge in front of the near plane, or of where a device may take it to be: its begin, and where it crosses
    /// the plane.
    void add_clipped(const Corner& a, const Corner& b) {
        const double near = std::max(double(view_.near) * .999 - std::max(a.error, b.error), double(view_.near) * .01);
        if (a.position.z >= near) add_pixel(a);
        if ((a.position.z >= near) != (b.position.z >= near))
            add_pixel(
                {glm::mix(a.position, b.position, (near - a.position.z) / (b.position.z - a.position.z)), a.error + b.error});
    }

    void add_pixel(const Corner& corner) {
        const glm::dvec3& p = corner.position;
        const double x = double(view_.projection[0][0]) * p.x / p.z + double(view_.projection[2][0]) + double(view_.jitter.x);
        const double y = double(view_.projection[1][1]) * p.y / p.z + double(view_.projection[2][1]) + double(view_.jitter.y);
        pixels_.emplace_back((.5 + .5 * x) * extent_.width, (.5 + .5 * y) * extent_.height);
        // An error across the ray moves a corner by `focal` halves of the image, one along it by as many as the image's far edge
        // is from the ray ahead. A corner beyond the edge moves more, but what it moves of an edge within the image is no more
        // than this.
        const double focal = std::max(std::abs(double(view_.projection[0][0])), std::abs(double(view_.projection[1][1])));
        const double off_x = std::abs(double(view_.projection[2][0]) + double(view_.jitter.x));
        const double off_y = std::abs(double(view_.projection[2][1]) + double(view_.jitter.y));
        const double far_edge = 1 + std::max(off_x, off_y);
        const double moved = corner.error / p.z * (.5 * focal + far_edge) + rounding * far_edge;
        margin_ = std::max(margin_, moved * std::max(extent_.width, extent_.height));
    }

    void add_pixels() {
        const double margin = snapping + margin_;
        glm::dvec2 low = pixels_[0], high = low;
        for (const glm::dvec2& p : pixels_) low = glm::min(low, p), high = glm::max(high, p);
        low -= margin, high += margin;
        const PixelRange columns(low.x, high.x, places_, extent_.width), rows(low.y, high.y, places_, extent_.height);
        overlaps_.add(columns, rows);
        if (columns.count() == 0) return;
        for (std::int64_t y = rows.first; y <= rows.last; ++y) {
            const double top = double(y) + places_.first - margin, bottom = double(y) + places_.last + margin;
            rows_[static_cast<std::size_t>(y)] += samples_ * touched(top, bottom, margin);
        }
    }

    /// Pixels in which the polygon can cover a sample between two heights.
    std::uint64_t touched(double top, double bottom, double margin) const {
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
        return PixelRange(low - margin, high + margin, places_, extent_.width).count();
    }

    const View& view_;
    Extent extent_;
    std::uint32_t samples_;
    Places places_;
    std::vector<std::uint64_t> rows_;
    Overlaps overlaps_;
    std::vector<glm::dvec2> pixels_;
    double margin_ = 0;  ///< pixels that the polygon's corners may be off
};

/// Of view positions that a device transforms itself: products and sums are as large as these, however small what they come to.
double transform_error(const glm::dmat4& to_view, const Mesh& mesh) {
    glm::dvec3 farthest(0);
    for (const glm::vec3& p : mesh.positions) farthest = glm::max(farthest, glm::abs(glm::dvec3(p)));
    glm::dvec3 terms = glm::abs(glm::dvec3(to_view[3]));
    for (int i = 0; i < 3; ++i) terms += glm::abs(glm::dvec3(to_view[i])) * farthest[i];
    return rounding * std::max({terms.x, terms.y, terms.z});
}

void add_draw(const Frame& frame, const Draw& draw, TouchedSamples& sum) {
    const Mesh& mesh = frame.meshes[draw.mesh];
    const glm::dmat4 to_view = glm::dmat4(frame.view.to_view) * glm::translate(glm::dmat4(1), -frame.view.origin) * draw.to_world;
    const double error = transform_error(to_view, mesh);
    std::vector<Corner> corners;
    corners.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions)
        corners.push_back({in_view_space(frame.view, glm::dvec3(draw.to_world * glm::dvec4(glm::dvec3(p), 1))), error});
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        sum.add(std::array{corners[mesh.indices[i]], corners[mesh.indices[i + 1]], corners[mesh.indices[i + 2]]});
}

/// The two triangles of a quad share no sample, so the quad counts once.
void add_particle(const Frame& frame, const Particle& particle, TouchedSamples& sum) {
    const glm::dvec3 center = in_view_space(frame.view, particle.center);
    const double c = std::cos(double(particle.rotation)) * double(particle.size);
    const double s = std::sin(double(particle.rotation)) * double(particle.size);
    const glm::dvec3 u(c, s, 0), v(-s, c, 0);
    const glm::dvec3 terms = glm::abs(center) + std::abs(c) + std::abs(s);
    const double error = rounding * std::max({terms.x, terms.y, terms.z});
    sum.add(std::array<Corner, 4>{
        {{center - u - v, error}, {center + u - v, error}, {center + u + v, error}, {center - u + v, error}}});
}

}  // namespace

FragmentBounds fragment_bounds(const Frame& frame, const DrawLists& lists, Extent extent, std::uint32_t samples) {
    TouchedSamples sum(frame.view, extent, samples);
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

std::vector<RowBand> row_bands(std::span<const std::uint64_t> fragments_by_row, std::uint64_t limit, std::uint32_t most_rows) {
    std::vector<RowBand> bands{{}};
    for (std::size_t y = 0; y < fragments_by_row.size(); y += 2) {
        const std::uint32_t rows = y + 1 < fragments_by_row.size() ? 2 : 1;
        const std::uint64_t pair = fragments_by_row[y] + (rows == 2 ? fragments_by_row[y + 1] : 0);
        const bool is_full = bands.back().bound + pair > limit || bands.back().rows + rows > most_rows;
        if (bands.back().rows > 0 && is_full) bands.push_back({.first_row = static_cast<std::uint32_t>(y)});
        bands.back().rows += rows;
        bands.back().bound += pair;
    }
    return bands;
}

}  // namespace strata
