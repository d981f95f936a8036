#include "passes/rain/wetness/traced_map_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/quaternion.hpp>

#include "capture_format/frame.h"
#include "passes/rain/wetness/wetness.shared.h"

namespace strata::rain {
namespace {

// Meters against the rain from which rays begin: above anything that casts.
constexpr double above = 1e5;
// Where nothing lies.
constexpr double nothing = 1e9;
// Positions snap to 1/256 texel in x and y when the device rasterizes.
constexpr double snap = 1.5 / 256;

/// The casters that count, masked ones without their holes.
Frame with_solid_casters(Frame frame, std::uint32_t casters) {
    for (Draw& draw : frame.draws)
        draw.casts_shadow = draw.casts_shadow && (casters == casters_all || draw.mobility == Mobility::fixed);
    for (Material& material : frame.materials)
        if (material.alpha_mode == AlphaMode::mask) material.alpha_mode = AlphaMode::opaque;
    return frame;
}

/// Nothing where no caster is masked.
std::optional<Frame> without_masked_casters(const Frame& recorded, const Frame& solid) {
    const auto has_holes = [&](const Draw& draw) {
        return draw.casts_shadow && recorded.materials[draw.material].alpha_mode == AlphaMode::mask;
    };
    if (std::ranges::none_of(solid.draws, has_holes)) return std::nullopt;
    Frame open = solid;
    for (Draw& draw : open.draws)
        if (has_holes(draw)) draw.casts_shadow = false;
    return open;
}

/// Radius and depth of the smallest sphere on the view axis around the corners of the view at the reach and the eye.
glm::dvec2 sphere_around_view(const View& view, double reach) {
    const double x = (1 + std::abs(double(view.projection[2][0]))) / std::abs(double(view.projection[0][0]));
    const double y = (1 + std::abs(double(view.projection[2][1]))) / std::abs(double(view.projection[1][1]));
    const double corner = reach * std::hypot(x, y);
    // Equally far from eye and corner: z = (reach^2 + corner^2) / (2 reach).
    const double middle = (reach * reach + corner * corner) / (2 * reach);
    return middle < reach ? glm::dvec2(middle, middle) : glm::dvec2(corner, reach);
}

/// Of the world, across the rain.
struct MapAxes {
    glm::dvec3 u, v;
};
MapAxes axes_along(const glm::dvec3& direction) {
    const glm::dvec3 helper = std::abs(direction.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(helper, direction));
    return {u, glm::cross(direction, u)};
}

}  // namespace

CastersInRain::CastersInRain(const Frame& frame, const WetnessParams& params)
    : solid_(with_solid_casters(frame, params.casters)),
      through_solid_(solid_, RayMask::shadow_casters),
      open_(without_masked_casters(frame, solid_)) {
    if (open_) through_open_.emplace(*open_, RayMask::shadow_casters);
}

std::vector<std::optional<double>> CastersInRain::distances(const glm::dvec3& origin, const glm::dvec3& direction,
                                                            double end) const {
    std::vector<std::optional<double>> found;
    const auto see = [&](const RayScene& scene) {
        const auto hit = scene.closest(origin, direction, 0, end);
        found.push_back(hit ? std::optional(hit->distance) : std::nullopt);
    };
    see(through_solid_);
    if (through_open_) see(*through_open_);
    return found;
}

std::vector<glm::dvec3> falling_directions(const Frame& frame, const WetnessParams& params) {
    const glm::dvec3 recorded = glm::normalize(glm::dvec3(frame.rain.direction));
    if (params.directions <= 1) return {recorded};
    // Turning about v tilts the rain towards u; turning that about the rain itself is the wind.
    const MapAxes axes = axes_along(recorded);
    const glm::dvec3 first = glm::angleAxis(glm::radians(double(params.spread)), axes.v) * recorded;
    std::vector<glm::dvec3> directions;
    for (std::uint32_t i = 0; i < params.directions; ++i)
        directions.push_back(glm::angleAxis(2 * std::numbers::pi * i / params.directions, recorded) * first);
    return directions;
}

TracedMap::TracedMap(const CastersInRain& casters, const Frame& frame, const WetnessParams& params, const glm::dvec3& direction)
    : casters_(&casters), size_(64u << params.map_size) {
    const View& view = frame.view;
    const glm::dvec2 sphere = sphere_around_view(view, double(params.reach));
    const double margin = std::min(2 * double(params.radius) + 3, size_ / 4.0);
    texel_ = 2 * sphere.x / (size_ - 2 * margin);
    const MapAxes axes = axes_along(direction);
    const glm::dvec3 center = view.origin + glm::transpose(view.to_view) * glm::dvec3(0, 0, sphere.y);
    const auto corner = [&](const glm::dvec3& axis) {
        const double on_grid = std::round(glm::dot(center, axis) / texel_) * texel_;
        return on_grid - 0.5 * size_ * texel_ - glm::dot(view.origin, axis);
    };
    corner_ = {corner(axes.u), corner(axes.v)};
    u_ = view.to_view * axes.u;
    v_ = view.to_view * axes.v;
    along_ = view.to_view * direction;
}

glm::dvec3 TracedMap::place(const glm::dvec3& position) const {
    return {(glm::dot(position, u_) - corner_.x) / texel_, (glm::dot(position, v_) - corner_.y) / texel_,
            glm::dot(position, along_)};
}

const TracedMap::Depths& TracedMap::depths(glm::ivec2 texel) const {
    const auto [found, is_new] =
        known_.try_emplace(static_cast<std::uint32_t>(texel.y) * size_ + static_cast<std::uint32_t>(texel.x));
    if (!is_new) return found->second;
    Depths seen{nothing, -nothing};
    for (const glm::dvec2 aside :
         {glm::dvec2(0, 0), glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
        const glm::dvec2 at = corner_ + (glm::dvec2(texel) + 0.5 + aside * snap) * texel_;
        for (const auto& distance : casters_->distances(u_ * at.x + v_ * at.y - along_ * above, along_, 2 * above)) {
            const double depth = distance ? *distance - above : nothing;
            seen = {std::min(seen.least, depth), std::max(seen.most, depth)};
        }
    }
    return found->second = seen;
}

Reached TracedMap::is_reached(glm::ivec2 texel, double depth, double doubt) const {
    if (std::min(texel.x, texel.y) < 0 || std::max(texel.x, texel.y) >= static_cast<int>(size_)) return {};
    const Depths& seen = depths(texel);
    const bool surely_open = depth <= seen.least - doubt, surely_closed = depth > seen.most + doubt;
    return {.open = depth <= 0.5 * (seen.least + seen.most), .undecided = !surely_open && !surely_closed};
}

}  // namespace strata::rain
