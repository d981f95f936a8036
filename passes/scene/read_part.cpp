#include "passes/scene/read_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace strata {
namespace {

constexpr int halvings = 4;  // of a map's edge

using Candidates = std::vector<const SurfaceBounds*>;

/// A rectangle of a map: u and v from 0 to 1.
struct Block {
    glm::dvec2 low{0}, high{1};
};

glm::dvec4 row(const glm::dmat4& m, int i) { return {m[0][i], m[1][i], m[2][i], m[3][i]}; }

/// Whether all of the bounds lie below the plane; never where a number is none.
bool is_below(const glm::dvec4& plane, const SurfaceBounds& surface) {
    const glm::dvec3 normal(plane);
    const double size = glm::length(normal);
    if (!(size > 0)) return false;
    if (glm::dot(normal, surface.sphere.center) + plane.w < -surface.sphere.radius * size) return true;
    return std::ranges::all_of(surface.corners, [&](const glm::dvec3& corner) {
        const double slack = stored_depth_error * (glm::length(corner) + surface.sphere.radius);
        return glm::dot(normal, corner) + plane.w < -slack * size;
    });
}

class Search {
public:
    Search(const Readers& readers, const ShadowView& map, const std::optional<BoundingSphere>& reach)
        : readers_(&readers),
          u_(row(map.view_to_map, 0)),
          v_(row(map.view_to_map, 1)),
          w_(row(map.view_to_map, 3)),
          from_map_(glm::inverse(map.view_to_map)),
          reach_(reach) {}

    /// Grows `found` by the block's parts that may be read.
    void add(const Block& block, const Candidates& among, int level, std::optional<Block>& found) const {
        if (!readers_->frustum().meets(corners(block))) return;
        const std::array planes = {u_ - block.low.x * w_, block.high.x * w_ - u_, v_ - block.low.y * w_, block.high.y * w_ - v_};
        Candidates inside;
        for (const SurfaceBounds* surface : among)
            if (std::ranges::none_of(planes, [&](const glm::dvec4& plane) { return is_below(plane, *surface); }))
                inside.push_back(surface);
        if (inside.empty()) return;
        if (level == halvings) {
            if (!found) found = block;
            found->low = glm::min(found->low, block.low);
            found->high = glm::max(found->high, block.high);
            return;
        }
        const glm::dvec2 middle = (block.low + block.high) / 2.;
        for (const double u : {0., 1.})
            for (const double v : {0., 1.}) {
                const glm::dvec2 low(u > 0 ? middle.x : block.low.x, v > 0 ? middle.y : block.low.y);
                add({low, low + (block.high - block.low) / 2.}, inside, level + 1, found);
            }
    }

    const glm::dvec4& axis() const { return w_; }

private:
    /// Of all that the map sees through the block, in view space.
    std::array<glm::dvec3, 8> corners(const Block& block) const {
        std::array<glm::dvec3, 8> all;
        std::size_t next = 0;
        for (const double u : {block.low.x, block.high.x})
            for (const double v : {block.low.y, block.high.y}) {
                if (!reach_) {
                    for (const double depth : {0., 1.}) all[next++] = glm::dvec3(from_map_ * glm::dvec4(u, v, depth, 1));
                    continue;
                }
                const glm::dvec4 at = from_map_ * glm::dvec4(u, v, .5, 1);
                const glm::dvec3 along = glm::dvec3(at) / at.w - reach_->center;
                const double ahead = glm::dot(glm::dvec3(w_), along);  // meters along the map's axis
                all[next++] = reach_->center;
                all[next++] = reach_->center + along * (reach_->radius / ahead);
            }
        return all;
    }

    const Readers* readers_;
    glm::dvec4 u_, v_, w_;
    glm::dmat4 from_map_;
    std::optional<BoundingSphere> reach_;
};

bool is_within(const BoundingSphere& sphere, const SurfaceBounds& surface) {
    return !(glm::distance(sphere.center, surface.sphere.center) > sphere.radius + surface.sphere.radius);
}

bool is_between(const ShadowView& cascade, const BoundingSphere& sphere) {
    return !(sphere.center.z + sphere.radius < cascade.read_from || sphere.center.z - sphere.radius > cascade.range_end);
}

}  // namespace

std::optional<MapPart> read_part(const Readers& readers, const ShadowView& map, const std::optional<BoundingSphere>& reach,
                                 std::uint32_t margin) {
    std::optional<Block> found;
    if (readers.has_exact_places()) {
        const Search search(readers, map, reach);
        Candidates among;
        for (const SurfaceBounds& surface : readers.surfaces()) {
            const bool is_reached =
                reach ? is_within(*reach, surface) && !is_below(search.axis(), surface) : is_between(map, surface.sphere);
            if (is_reached) among.push_back(&surface);
        }
        search.add({}, among, 0, found);
    } else if (readers.has_surfaces()) {
        found = Block{};
    }
    if (!found) return {};
    const auto texels = [&](double low, double high) {
        const double first = std::max(0., std::floor(low * map.size) - margin);
        const double end = std::min(double(map.size), std::ceil(high * map.size) + margin);
        return std::array{std::uint32_t(first), std::uint32_t(end - first)};
    };
    const auto [column, columns] = texels(found->low.x, found->high.x);
    const auto [first_row, rows] = texels(found->low.y, found->high.y);
    return MapPart{{column, columns}, {first_row, rows}};
}

}  // namespace strata
