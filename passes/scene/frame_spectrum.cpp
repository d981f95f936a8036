#include "passes/scene/frame_spectrum.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/material.h"
#include "capture_format/light_types.h"
#include "passes/scene/light_features.h"
#include "passes/scene/view_space.h"
#include "passes/shaders/light_features.shared.h"

namespace strata {
namespace {

constexpr double single_precision_margin = 1e-4;  // of a sphere's distance and size: what tiles test is rounded to floats

/// What the eye sees, without an end.
class Frustum {
public:
    explicit Frustum(const Frame& frame) : near_(frame.view.near) {
        const double w = frame.view.width, h = frame.view.height;
        const std::array corners = {ray_through(frame.view, 0, 0), ray_through(frame.view, w, 0), ray_through(frame.view, w, h),
                                    ray_through(frame.view, 0, h)};
        const glm::dvec3 middle = ray_through(frame.view, w / 2, h / 2);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec3 normal = glm::normalize(glm::cross(corners[i], corners[(i + 1) % corners.size()]));
            inward_[i] = glm::dot(normal, middle) < 0 ? -normal : normal;
        }
    }
    /// Never false for a sphere that a tile's own tests keep. Those test planes one by one, so that a sphere around the near
    /// plane beside the view passes them: such a one is kept here, too.
    bool meets(const BoundingSphere& sphere) const {
        const double reach = sphere.radius + single_precision_margin * (sphere.radius + glm::length(sphere.center));
        if (sphere.center.z + reach < near_) return false;
        if (sphere.center.z - reach <= 0) return true;
        return std::ranges::none_of(inward_, [&](const glm::dvec3& normal) { return glm::dot(normal, sphere.center) < -reach; });
    }

private:
    double near_;
    std::array<glm::dvec3, 4> inward_{};
};

/// Of each kind of light that may reach a tile.
std::set<std::uint32_t> features_by_light(const Frame& frame, std::span<const Light> lights, const Frustum& frustum) {
    std::set<std::uint32_t> features;
    for (const Light& light : lights)
        if (!has_range(light.type) || frustum.meets({in_view_space(frame.view, light.position), double(light.range)}))
            features.insert(light_features(light));
    return features;
}

std::uint32_t features_of_surfaces(const Frame& frame, const DrawBounds& bounds, const Frustum& frustum) {
    std::uint32_t features = 0;
    for (std::uint32_t i = 0; i < frame.draws.size(); ++i) {
        const Material& material = frame.materials[frame.draws[i].material];
        const std::uint32_t needed = is_transparent(material.alpha_mode) ? 0 : model_feature(material.lighting_model);
        if ((needed & ~features) != 0 && frustum.meets(bounds.spheres[i])) features |= needed;
    }
    return features;
}

/// Volumes whose light stops at blockers are read tap by tap (docs/algorithms/lighting.md 5.8). Settings may make it stop in any
/// volume, whatever is recorded.
std::uint32_t features_of_volumes(const Frame& frame) {
    return !frame.light_volumes.empty() && !frame.blockers.empty() ? feature_gi_tap_visibility : 0;
}

// Of a light: those that a tile may lack though the light is in its list.
constexpr std::uint32_t features_of_some_tiles =
    feature_blockers | feature_portals | feature_shadows | feature_soft_shadows | feature_clip_planes;

void add_each_bit(std::uint32_t always, std::uint32_t optional, std::set<std::uint32_t>& parts) {
    for (; optional != 0; optional &= optional - 1) parts.insert(always | (optional & ~(optional - 1)));
}

/// Spectra of which every other one is a union.
std::set<std::uint32_t> spectrum_parts(const Frame& frame, std::span<const Light> lights, const DrawBounds& bounds,
                                       std::uint32_t features) {
    const Frustum frustum(frame);
    std::set<std::uint32_t> parts;
    for (const std::uint32_t light : features_by_light(frame, lights, frustum)) {
        const std::uint32_t always = light & features & ~features_of_some_tiles;
        parts.insert(always);
        add_each_bit(always, light & features & features_of_some_tiles, parts);
    }
    add_each_bit(0, features & (features_of_surfaces(frame, bounds, frustum) | features_of_volumes(frame)), parts);
    return parts;
}

}  // namespace

std::uint32_t frame_spectrum(const Frame& frame, std::span<const Light> lights, const DrawBounds& bounds) {
    const Frustum frustum(frame);
    std::uint32_t features = features_of_surfaces(frame, bounds, frustum) | features_of_volumes(frame);
    for (const std::uint32_t light : features_by_light(frame, lights, frustum)) features |= light;
    return features;
}

std::vector<std::uint32_t> possible_spectra(const Frame& frame, std::span<const Light> lights, const DrawBounds& bounds,
                                            std::uint32_t features) {
    std::vector<bool> is_known(std::size_t{every_light_feature} + 1);
    std::vector<std::uint32_t> spectra{0};
    is_known[0] = true;
    for (const std::uint32_t part : spectrum_parts(frame, lights, bounds, features & every_light_feature))
        for (std::size_t i = 0, before = spectra.size(); i < before; ++i) {
            const std::uint32_t spectrum = spectra[i] | part;
            if (!is_known[spectrum]) spectra.push_back(spectrum);
            is_known[spectrum] = true;
        }
    return spectra;
}

}  // namespace strata
