#include "passes/scene/readers.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "passes/scene/view_space.h"

namespace strata {
namespace {

std::array<glm::dvec3, 8> corners_in_view(const Frame& frame, const DrawBounds& bounds, std::uint32_t index) {
    const Draw& draw = frame.draws[index];
    std::array<glm::dvec3, 8> corners = corners_of(bounds.boxes[draw.mesh]);
    for (glm::dvec3& corner : corners) corner = in_view_space(frame.view, glm::dvec3(draw.to_world * glm::dvec4(corner, 1)));
    return corners;
}

/// A sphere is a loose bound of a floor: where it does not decide, the draw's own box does.
bool may_show(const Frame& frame, const Frustum& frustum, const DrawBounds& bounds, std::uint32_t index) {
    const BoundingSphere& sphere = bounds.spheres[index];
    if (!frustum.meets(sphere)) return false;
    return frustum.contains(sphere) || frustum.meets(corners_in_view(frame, bounds, index));
}

/// Particles are squares that face the eye.
BoundingSphere sphere_around(const Frame& frame, const Emitter& emitter) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const Particle& particle : emitter.particles) {
        const glm::dvec3 center = in_view_space(frame.view, particle.center), size(std::numbers::sqrt2 * double(particle.size));
        low = glm::min(low, center - size), high = glm::max(high, center + size);
    }
    return {(low + high) / 2., glm::length(high - low) / 2};
}

BoundingSphere widened(const BoundingSphere& sphere) {
    return {sphere.center, sphere.radius + stored_depth_error * (glm::length(sphere.center) + sphere.radius)};
}

// Comparisons are negated: bounds that are no numbers, of a particle at infinity, meet all.

bool meet(const BoundingSphere& a, const BoundingSphere& b) { return !(glm::distance(a.center, b.center) > a.radius + b.radius); }

}  // namespace

Readers::Readers(const Frame& frame, const DrawLists& lists, const DrawBounds& bounds) : frame_(&frame), frustum_(frame.view) {
    for (const std::uint32_t draw : lists.opaque)
        if (may_show(frame, frustum_, bounds, draw))
            surfaces_.push_back({widened(bounds.spheres[draw]), corners_in_view(frame, bounds, draw)});
    for (const std::uint32_t index : lists.transparent) {
        if (index < frame.draws.size()) {
            if (may_show(frame, frustum_, bounds, index)) fragments_.push_back(widened(bounds.spheres[index]));
            continue;
        }
        const Emitter& emitter = frame.emitters[index - frame.draws.size()];
        if (emitter.particles.empty()) continue;
        if (const BoundingSphere sphere = sphere_around(frame, emitter); frustum_.meets(sphere))
            fragments_.push_back(widened(sphere));
    }
}

bool Readers::has_exact_places() const { return frame_->view.samples == 1; }

bool Readers::has_surfaces_between(double nearest, double farthest) const {
    if (!has_exact_places()) return has_surfaces();
    return std::ranges::any_of(surfaces_, [&](const SurfaceBounds& surface) {
        const BoundingSphere& sphere = surface.sphere;
        return !(sphere.center.z + sphere.radius < nearest || sphere.center.z - sphere.radius > farthest);
    });
}

bool Readers::has_surfaces_in(const BoundingSphere& sphere) const {
    if (!has_exact_places()) return has_surfaces();
    return frustum_.meets(sphere) &&
           std::ranges::any_of(surfaces_, [&](const SurfaceBounds& surface) { return meet(surface.sphere, sphere); });
}

bool Readers::has_any_in(const BoundingBox& world) const {
    if (!has_exact_places()) return has_surfaces() || !fragments_.empty();
    if (!frustum_.meets(view_corners_of(frame_->view, world))) return false;
    const auto meets_box = [&](const BoundingSphere& sphere) {
        const glm::dvec3 center = glm::transpose(frame_->view.to_view) * sphere.center + frame_->view.origin;
        return !(glm::distance(glm::clamp(center, world.low, world.high), center) > sphere.radius);
    };
    return std::ranges::any_of(surfaces_, meets_box, &SurfaceBounds::sphere) || std::ranges::any_of(fragments_, meets_box);
}

}  // namespace strata
