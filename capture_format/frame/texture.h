// Textures of a frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace strata {

enum class TextureFormat : std::uint32_t { rgba8_unorm, rgba8_srgb, rgba16f, rgba32f };
/// What lies beyond a texture's edges: of both axes, or of u and then of v, which address_u() and address_v() give alone.
enum class AddressMode : std::uint32_t {
    repeat,
    clamp,
    mirror,
    repeat_clamp,
    repeat_mirror,
    clamp_repeat,
    clamp_mirror,
    mirror_repeat,
    mirror_clamp
};
AddressMode address_u(AddressMode), address_v(AddressMode);
/// Between the texels of a mip.
enum class TexelFilter : std::uint32_t { linear, nearest };
/// Between two mips; none: the finest is read alone.
enum class MipFilter : std::uint32_t { linear, nearest, none };

/// Texels of every mip, finest first, rows top to bottom, tightly packed. Mip n is max(1, extent >> n). Filters are those of
/// surfaces and particles; pictures of lights are filtered linearly.
struct Texture {
    std::string name;
    TextureFormat format = TextureFormat::rgba8_unorm;
    std::uint32_t width = 0, height = 0, mips = 1;
    AddressMode address = AddressMode::repeat;
    TexelFilter magnify = TexelFilter::linear;  ///< where a pixel covers one texel of the finest mip or less
    TexelFilter minify = TexelFilter::linear;   ///< where it covers more
    MipFilter between_mips = MipFilter::linear;
    std::vector<std::byte> texels;
};

}  // namespace strata
