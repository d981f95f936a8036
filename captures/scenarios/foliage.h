// Leaves and grass: masked cards and their textures.
#pragma once

#include <cstdint>
#include <string>

#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/texture.h"

namespace strata::scenario {

/// A spray of pointed leaves, for alpha masking; `length` is a leaf's in edges of the texture.
Texture leaf_spray(std::uint64_t seed, int count, float length);
/// Blades that lean, from the lower edge up.
Texture grass_blades(std::uint64_t seed);
/// A matt material that the texture's alpha cuts out.
Material masked(std::string name, std::uint32_t texture);
/// Cards all around in a ball of radius 1, their fronts outwards; `half` is half an edge of a card.
Mesh crown(std::uint64_t seed, int cards, float half);
/// Crossed cards of height 1 that stand on y = 0.
Mesh tuft();

}  // namespace strata::scenario
