#include "passes/gbuffer/coverage/mip_scales.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <utility>
#include <vector>

#include <glm/gtc/packing.hpp>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/texture.h"

namespace strata::gbuffer {
namespace {

std::size_t texel_bytes(TextureFormat format) {
    return format == TextureFormat::rgba32f ? 16 : format == TextureFormat::rgba16f ? 8 : 4;
}

/// Of a texel at its first byte.
double alpha_at(const std::byte* texel, TextureFormat format) {
    if (format == TextureFormat::rgba32f) {
        float alpha = 0;
        std::memcpy(&alpha, texel + 12, sizeof alpha);
        return double(alpha);
    }
    if (format == TextureFormat::rgba16f) {
        std::uint16_t alpha = 0;
        std::memcpy(&alpha, texel + 6, sizeof alpha);
        return double(glm::unpackHalf1x16(alpha));
    }
    return std::to_integer<int>(texel[3]) / 255.0;
}

std::size_t texels_of(const Texture& texture, std::uint32_t mip) {
    return std::size_t(std::max(1u, texture.width >> mip)) * std::max(1u, texture.height >> mip);
}

/// Alphas of a mip, largest first. Mips follow each other, finest first.
std::vector<double> sorted_alphas(const Texture& texture, std::uint32_t mip) {
    const std::size_t stride = texel_bytes(texture.format);
    const std::byte* texel = texture.texels.data();
    for (std::uint32_t finer = 0; finer < mip; ++finer) texel += stride * texels_of(texture, finer);
    std::vector<double> alphas(texels_of(texture, mip));
    for (double& alpha : alphas) alpha = alpha_at(std::exchange(texel, texel + stride), texture.format);
    std::ranges::sort(alphas, std::greater());
    return alphas;
}

/// How many of them stay so that their share is nearest to `share`, without parting equal ones; the more of two as near.
std::size_t nearest_count(const std::vector<double>& alphas, double share) {
    const double wanted = share * double(alphas.size());
    const auto place = std::min(static_cast<std::size_t>(wanted), alphas.size() - 1);
    const auto above = std::ranges::lower_bound(alphas, alphas[place], std::greater()) - alphas.begin();
    const auto below = std::ranges::upper_bound(alphas, alphas[place], std::greater()) - alphas.begin();
    return std::abs(double(above) - wanted) < std::abs(double(below) - wanted) ? std::size_t(above) : std::size_t(below);
}

/// The alpha between those that stay and those that go.
double threshold(const std::vector<double>& alphas, std::size_t staying) {
    if (staying == 0) return alphas.front() * (1 + 1e-3);
    return staying == alphas.size() ? alphas.back() * (1 - 1e-3) : 0.5 * (alphas[staying - 1] + alphas[staying]);
}

}  // namespace

std::array<float, mask_scale_mips> mip_scales(const Frame& frame, const Material& material) {
    std::array<float, mask_scale_mips> scales;
    scales.fill(1);
    if (material.base_color_texture.texture == no_index || !(material.base_color.w > 0)) return scales;
    const Texture& texture = frame.textures[material.base_color_texture.texture];
    const double cutoff = double(material.mask_cutoff) / double(material.base_color.w);
    const std::vector<double> finest = sorted_alphas(texture, 0);
    const auto staying = std::ranges::upper_bound(finest, cutoff, std::greater()) - finest.begin();
    if (staying == 0 || staying == std::ssize(finest)) return scales;
    const double share = double(staying) / double(finest.size());
    for (std::uint32_t mip = 1; mip < mask_scale_mips; ++mip) {
        if (mip >= texture.mips) {
            scales[mip] = scales[mip - 1];
            continue;
        }
        const std::vector<double> alphas = sorted_alphas(texture, mip);
        const double at = threshold(alphas, nearest_count(alphas, share));
        if (at > 0) scales[mip] = static_cast<float>(cutoff / at);
    }
    return scales;
}

}  // namespace strata::gbuffer
