// What shading a light needs, as bits of passes/shaders/light_features.shared.h.
#pragma once

#include <cstdint>
#include <span>

#include "capture_format/frame/material.h"

namespace strata {

struct Frame;  // capture_format/frame.h
struct Light;  // capture_format/frame/light.h

/// Of one light: its type, shadows, sign, clip planes, picture, blockers and portals.
std::uint32_t light_features(const Light&);

/// Of surfaces of a model: none for those that every variant can shade.
std::uint32_t model_feature(LightingModel);

/// Of the lights of a frame that shine (light_list.h), and of its materials.
std::uint32_t light_features(const Frame&, std::span<const Light>);

}  // namespace strata
