#include "passes/scene/light_features.h"

#include <algorithm>

#include "passes/scene/light_list.h"
#include "passes/shaders/light_features.shared.h"

namespace strata {
namespace {

std::uint32_t of_type(LightType type) {
    switch (type) {
        case LightType::omni:
            return feature_omni;
        case LightType::round_spot:
            return feature_round_spot;
        case LightType::square_spot:
            return feature_square_spot;
        case LightType::tube:
            return feature_tube;
        case LightType::sphere:
        case LightType::disc:
        case LightType::rectangle:
            return feature_area;
        case LightType::directional:
            break;
    }
    return 0;
}

bool shows_picture(const Light& light) {
    const bool can =
        light.type == LightType::round_spot || light.type == LightType::square_spot || light.type == LightType::rectangle;
    return can && light.texture != no_index;
}

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

std::uint32_t light_features(const Frame& frame) {
    std::uint32_t bits = 0;
    for (const Light& light : light_list(frame)) bits |= light_features(light);
    for (const Material& material : frame.materials) bits |= model_feature(material.lighting_model);
    return bits;
}

}  // namespace strata
