// Texels in double: filtering as passes/shaders/material.glsl defines them, without any sampler.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace strata {

struct Texture;     // capture_format/frame/texture.h
struct TextureUse;  // capture_format/frame/material.h

/// The piecewise curve of IEC 61966-2-1, display value to linear, and back.
double srgb_to_linear(double encoded);
double linear_to_srgb(double linear);

/// One texel of one mip, decoded to linear; x and y inside the mip.
glm::dvec4 texel(const Texture&, std::uint32_t mip, std::uint32_t x, std::uint32_t y);

/// The four texels around uv, weighted; texel centers are at (i + .5) / size. Addressing applies to every tap.
glm::dvec4 bilinear(const Texture&, std::uint32_t mip, const glm::dvec2& uv);

/// Two bilinear taps mixed by the fraction of the level of detail, which is clamped to [0, mips - 1].
glm::dvec4 trilinear(const Texture&, const glm::dvec2& uv, double lod);

/// As the texture's filters say, at any level of detail: 0 or less is magnified.
glm::dvec4 filtered(const Texture&, const glm::dvec2& uv, double lod);

/// log2 of the longer of the two derivatives of uv per pixel, in texels of mip 0.
double level_of_detail(const Texture&, const glm::dvec2& uv_per_x, const glm::dvec2& uv_per_y);

/// uv through the affine transform of a TextureUse.
glm::dvec2 transformed(const TextureUse&, const glm::dvec2& uv);

}  // namespace strata
