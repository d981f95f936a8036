// Procedural textures with mips.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "capture_format/frame/texture.h"

namespace strata::scenario {

/// `cells` x `cells` squares of two linear colors, sRGB texels.
Texture checker(std::uint32_t cells, glm::vec3 light, glm::vec3 dark);
/// A puff: white, alpha falls smoothly to exactly 0 at the border and is torn by noise.
Texture puff(std::uint64_t seed);
/// A round glow, alpha (1 - r^2)^2.
Texture glow();
/// A drop that fell while the shutter was open: an upright line, a tenth as wide as long.
Texture streak();
/// Leaves on stems with holes between them, for alpha masking; clamps at its border.
Texture foliage(std::uint64_t seed);
/// A normal map of round studs, `cells` x `cells`.
Texture studs(std::uint32_t cells);

}  // namespace strata::scenario
