// How procedural textures are painted: a function of uv, sampled per texel; relief turned into normals; noise that tiles.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <glm/glm.hpp>

#include "capture_format/frame/texture.h"

namespace strata::scenario {

struct Canvas {
    std::uint32_t edge = 64;  ///< texels
    TextureFormat format = TextureFormat::rgba8_srgb;
    std::uint32_t places = 1;  ///< a texel is the mean of places x places samples
};

/// Linear color and alpha at uv in 0..1. Alpha does not weigh color, so a transparent texel needs the color of its neighbors.
using Paint = std::function<glm::vec4(glm::vec2 uv)>;

Texture painted(std::string name, const Canvas&, const Paint&);
/// The normal map of a height that repeats, in edges of the texture. Green is up.
Texture relief(std::string name, std::uint32_t edge, const std::function<float(glm::vec2 uv)>& height);

/// Value noise of a lattice, 0..1, smooth.
float noise(glm::vec2 p, std::uint64_t seed);
/// Four octaves of noise, 0..1.
float fractal_noise(glm::vec2 p, std::uint64_t seed);
/// Noise that repeats after `cells` lattice cells: the first of three octaves has that many, over uv in 0..1.
float tiling_noise(glm::vec2 uv, std::uint32_t cells, std::uint64_t seed);
/// A number in 0..1 for each pair of integers.
float hashed(std::int64_t x, std::int64_t y, std::uint64_t seed);

}  // namespace strata::scenario
