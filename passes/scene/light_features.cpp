#include "passes/scene/light_features.h"

#include <algorithm>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/light_types.h"
#include "passes/shaders/light_features.shared.h"

namespace strata {
namespace {

std::uint32_t of_type(LightType type) {
    const LightTypeFacts& facts = facts_of(type);
    if (facts.cone != LightCone::none) return facts.cone == LightCone::round ? feature_round_spot : feature_square_spot;
    switch (facts.shape) {
        case LightShape::point:
            return feature_omni;
        case LightShape::tube:
            return feature_tube;
        case LightShape::sphere:
        case LightShape::disc:
        case LightShape::rectangle:
            return feature_area;
        case LightShape::parallel:
            break;
    }
    return 0;
}

bool shows_picture(const Light& light) { return facts_of(light.type).shows_picture && light.texture != no_index; }

}  // namespace

std::uint32_t model_feature(LightingModel model) {
    switch (model) {
        case LightingModel::cloth:
            return feature_cloth;
        case LightingModel::skin:
            return feature_skin;
        case LightingModel::hair:
            return feature_hair;
        default:
            return 0;
    }
}

std::uint32_t light_features(const Light& light) {
    std::uint32_t bits = of_type(light.type);
    if (!light.blockers.empty()) bits |= feature_blockers;
    if (!light.blockers.empty() && !light.portals.empty()) bits |= feature_portals;
    if (light.shadow.casts) bits |= feature_shadows | (light.shadow.soft ? feature_soft_shadows : 0);
    if (shows_picture(light)) bits |= feature_projected_texture;
    if (std::min({light.intensity.x, light.intensity.y, light.intensity.z}) < 0) bits |= feature_darks;
    if (!light.clip_planes.empty()) bits |= feature_clip_planes;
    return bits;
}

std::uint32_t light_features(const Frame& frame, std::span<const Light> lights) {
    std::uint32_t bits = 0;
    for (const Light& light : lights) bits |= light_features(light);
    for (const Material& material : frame.materials) bits |= model_feature(material.lighting_model);
    return bits;
}

}  // namespace strata
