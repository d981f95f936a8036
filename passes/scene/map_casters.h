// Finding the casters of a part of a map on the device (passes/shaders/map_casters.glsl).
#pragma once

#include "passes/scene/read_part.h"
#include "passes/shaders/map_casters.shared.h"

namespace strata {

/// From view space to x and y from -1 to 1.
glm::dmat4 to_clip(const ShadowView&);
/// Of parallel light; `casters`: theirs among all commands.
MapCastersPush casters_push(const ShadowView&, const MapPart&, const DrawList& casters);

}  // namespace strata
