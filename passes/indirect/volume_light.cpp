#include "passes/indirect/volume_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "passes/indirect/leg_blockers.h"
#include "passes/indirect/light_grid.shared.h"

namespace strata::indirect {
namespace {

using std::numbers::pi;

// docs/algorithms/lighting.md 5.8: metres before the surface from which taps are asked about, the least share of taps that stands
// for all, and the area of a unit cube seen from anywhere, in the mean.
constexpr double tap_start = 0.02, least_share = 0.02, mean_section = 1.5;

/// A place relative to the eye, along the world's axes.
struct Place {
    glm::dvec3 position{0}, normal{0};
};

/// l0 and l1 of each channel.
using Cell = std::array<glm::dvec4, 3>;

struct VolumeGrid {
    glm::dvec3 origin{0}, cells{1};
    double cell = 1, border = 1;  ///< metres
    bool asks_taps = false;
    std::size_t first_cell = 0;  ///< a record

    double share_at(const glm::dvec3& position) const {
        const glm::dvec3 from_low = position - origin, from_high = cells * cell - from_low, depth = glm::min(from_low, from_high);
        return std::clamp(std::min({depth.x, depth.y, depth.z}) / border, 0.0, 1.0);
    }
    bool holds(const glm::dvec3& at) const {
        return glm::all(glm::greaterThanEqual(at, glm::dvec3(0))) && glm::all(glm::lessThan(at, cells));
    }
    std::size_t record(const glm::dvec3& at) const {
        return first_cell + static_cast<std::size_t>((at.z * cells.y + at.y) * cells.x + at.x);
    }
};

/// The frame's blockers, which all stop bounced light from both sides.
LegBlockers two_sided(const Frame& frame) {
    Frame walls;
    walls.view = frame.view;
    walls.blockers = frame.blockers;
    walls.portals = frame.portals;
    for (Blocker& blocker : walls.blockers) blocker.one_sided = false;
    return LegBlockers(walls);
}

class Volumes {
public:
    Volumes(const Frame& frame, const ReferenceImage& image)
        : image_(&image), blockers_(two_sided(frame)), to_view_(frame.view.to_view) {
        const glm::dvec4 rule = texel(0, 2);
        is_of_face_ = rule.y == double(irradiance_face);
        const auto count = static_cast<std::size_t>(rule.z);
        std::size_t first_cell = count;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec4 corner = texel(i, 0), size = texel(i, 1);
            const glm::dvec3 cells(size);
            grids_.push_back({.origin = glm::dvec3(corner),
                              .cells = cells,
                              .cell = corner.w,
                              .border = size.w,
                              .asks_taps = texel(i, 2).x != 0,
                              .first_cell = first_cell});
            first_cell += static_cast<std::size_t>(cells.x * cells.y * cells.z);
        }
    }

    /// View space.
    glm::dvec3 at(const glm::dvec3& position, const glm::dvec3& normal) const {
        const glm::dmat3 to_world = glm::transpose(to_view_);
        const Place place{to_world * position, to_world * normal};
        glm::dvec3 sum(0);
        double left = 1;
        for (const VolumeGrid& grid : grids_) {
            const double share = grid.share_at(place.position);
            if (share == 0) continue;
            sum += left * share * of_grid(grid, place);
            left *= 1 - share;
        }
        return sum;
    }

private:
    glm::dvec4 texel(std::size_t record, std::size_t i) const { return image_->texels[texels_per_record * record + i]; }

    /// The mean of the cells around half a cell before the place, without those that a blocker hides from it.
    Cell seen(const VolumeGrid& grid, const Place& place) const {
        const glm::dvec3 middle = (place.position - grid.origin) / grid.cell + place.normal / 2.0 - 0.5;
        const glm::dvec3 low = glm::floor(middle), part = middle - low;
        const glm::dvec3 start = to_view_ * (place.position + tap_start * place.normal);
        Cell sum{};
        double weights = 0;
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 step(i % 2, i / 2 % 2, i / 4), cell = low + step;
            const glm::dvec3 end = to_view_ * (grid.origin + grid.cell * (cell + 0.5));
            if (grid.asks_taps && !blockers_.let_through(start, end)) continue;
            const glm::dvec3 w = glm::mix(1.0 - part, part, step);
            weights += w.x * w.y * w.z;
            if (!grid.holds(cell)) continue;
            for (std::size_t c = 0; c < 3; ++c) sum[c] += w.x * w.y * w.z * texel(grid.record(cell), c);
        }
        for (glm::dvec4& channel : sum) channel = weights < least_share ? glm::dvec4(0) : channel / weights;
        return sum;
    }

    /// Cells hold what leaves them: what arrives at a surface travels against its normal. Without a normal l0 alone counts.
    double towards(const glm::dvec4& cell, const glm::dvec3& normal) const {
        const double along = glm::dot(glm::dvec3(cell.y, cell.z, cell.w), normal);
        const double intensity = (cell.x - std::sqrt(3.0) * along) / (2 * std::sqrt(pi));  // W/sr
        const double received = std::sqrt(pi) / 2 * cell.x - std::sqrt(pi / 3) * along;    // W through a plane
        return std::max(0.0, is_of_face_ ? 4 * intensity : received / mean_section) / pi;
    }

    glm::dvec3 of_grid(const VolumeGrid& grid, const Place& place) const {
        const Cell cell = seen(grid, place);
        const glm::dvec3 light(towards(cell[0], place.normal), towards(cell[1], place.normal), towards(cell[2], place.normal));
        return light / (grid.cell * grid.cell);
    }

    const ReferenceImage* image_;
    LegBlockers blockers_;
    glm::dmat3 to_view_;
    bool is_of_face_ = true;
    std::vector<VolumeGrid> grids_;
};

}  // namespace

LightAround volume_light(const Frame& frame, const ImageSet& before) {
    const auto found = before.find("volume_light");
    if (found == before.end()) return {};
    const auto volumes = std::make_shared<const Volumes>(frame, found->second);
    return [volumes](const glm::dvec3& position, const glm::dvec3& normal) { return volumes->at(position, normal); };
}

}  // namespace strata::indirect
