// What shading a light needs, as bits of passes/shaders/light_features.shared.h.
#pragma once

#include <cstdint>

#include "capture_format/frame.h"

namespace strata {

/// Of one light: its type, shadows, sign, clip planes, picture, blockers and portals.
std::uint32_t light_features(const Light&);

/// Of all lights of a frame that shine, the sun too, and of its materials.
std::uint32_t light_features(const Frame&);

}  // namespace strata
