// How many bytes the texels of a texture take.
#pragma once

#include <algorithm>
#include <cstdint>

#include "capture_format/frame/texture.h"

namespace strata {

/// Bytes of one texel; 0 for a format that does not exist.
constexpr std::uint64_t texel_bytes(TextureFormat format) {
    switch (format) {
        case TextureFormat::rgba8_unorm:
        case TextureFormat::rgba8_srgb:
            return 4;
        case TextureFormat::rgba16f:
            return 8;
        case TextureFormat::rgba32f:
            return 16;
    }
    return 0;
}

/// Bytes of all mips, tightly packed. Mips must be below 32.
constexpr std::uint64_t texture_bytes(const Texture& texture) {
    std::uint64_t texels = 0;
    for (std::uint32_t mip = 0; mip < texture.mips; ++mip) {
        texels += std::uint64_t{std::max(1u, texture.width >> mip)} * std::max(1u, texture.height >> mip);
    }
    return texels * texel_bytes(texture.format);
}

}  // namespace strata
