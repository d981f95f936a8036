// What the maps of lights show of a frame's casters, as hashes: equal ones look the same from everywhere.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace strata {

struct Frame;  // capture_format/frame.h

/// Of each of these draws: its vertices, its place in the world, its material and what of the material's textures a light
/// reflects. Reads every vertex and texel once, however many draws have them.
std::vector<std::uint64_t> caster_hashes(const Frame&, std::span<const std::uint32_t> draws);

}  // namespace strata
