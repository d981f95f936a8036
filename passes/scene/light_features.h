// What shading a light needs, as bits of passes/shaders/light_features.shared.h.
#pragma once

#include <cstdint>

#include "capture_format/frame.h"

namespace strata {

/// Of one light: its type, shadows, sign, clip planes, picture, blockers and portals.
std::uint32_t light_features(const Light&);

/// Of surfaces of a model: none for those that every variant can shade.
std::uint32_t model_feature(LightingModel);

/// Of all lights of a frame that shine, the sun too, and of its materials.
std::uint32_t light_features(const Frame&);

}  // namespace strata
