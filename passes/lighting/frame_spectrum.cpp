#include "passes/lighting/frame_spectrum.h"

#include <algorithm>
#include <array>

#include "passes/lighting/light_features.h"
#include "passes/reference/bounds.h"
#include "passes/reference/shade.h"
#include "passes/shaders/light_features.shared.h"
#include "passes/shadows/shadow_views.h"

namespace strata::lighting {
namespace {

constexpr double single_precision_margin = 1e-4;  // of a sphere's distance and size: what tiles test is rounded to floats

/// What the eye sees, without an end.
class Frustum {
public:
    explicit Frustum(const Frame& frame) : near_(frame.view.near) {
        const double w = frame.view.width, h = frame.view.height;
        const std::array corners = {pixel_ray(frame, 0, 0), pixel_ray(frame, w, 0), pixel_ray(frame, w, h),
                                    pixel_ray(frame, 0, h)};
        const glm::dvec3 middle = pixel_ray(frame, w / 2, h / 2);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec3 normal = glm::normalize(glm::cross(corners[i], corners[(i + 1) % corners.size()]));
            inward_[i] = glm::dot(normal, middle) < 0 ? -normal : normal;
        }
    }
    /// Never false for a sphere that a tile's own tests keep. Those test planes one by one, so that a sphere around the near
    /// plane beside the view passes them: such a one is kept here, too.
    bool meets(const Sphere& sphere) const {
        const double reach = sphere.radius + single_precision_margin * (sphere.radius + glm::length(sphere.center));
        if (sphere.center.z + reach < near_) return false;
        if (sphere.center.z - reach <= 0) return true;
        return std::ranges::none_of(inward_, [&](const glm::dvec3& normal) { return glm::dot(normal, sphere.center) < -reach; });
    }

private:
    double near_;
    std::array<glm::dvec3, 4> inward_{};
};

std::uint32_t features_of_lights(const Frame& frame, const Frustum& frustum) {
    std::uint32_t features = 0;
    for (const Light& light : shadow_lights(frame))
        if (light.type == LightType::directional || frustum.meets({to_view(frame, light.position), double(light.range)}))
            features |= light_features(light);
    return features;
}

std::uint32_t features_of_surfaces(const Frame& frame, const Frustum& frustum) {
    std::uint32_t features = 0;
    for (std::uint32_t i = 0; i < frame.draws.size(); ++i) {
        const Material& material = frame.materials[frame.draws[i].material];
        const std::uint32_t needed = is_transparent(material.alpha_mode) ? 0 : model_feature(material.lighting_model);
        if ((needed & ~features) != 0 && frustum.meets(bounding_sphere(frame, i))) features |= needed;
    }
    return features;
}

/// Volumes whose light stops at blockers are looked up tap by tap (chapter 5.8).
std::uint32_t features_of_volumes(const Frame& frame) {
    const bool taps = std::ranges::count(frame.light_volumes, VolumeOcclusion::axial, &LightVolume::occlusion) > 0;
    return taps && !frame.blockers.empty() ? feature_gi_tap_visibility : 0;
}

}  // namespace

std::uint32_t frame_spectrum(const Frame& frame) {
    const Frustum frustum(frame);
    return features_of_lights(frame, frustum) | features_of_surfaces(frame, frustum) | features_of_volumes(frame);
}

}  // namespace strata::lighting
