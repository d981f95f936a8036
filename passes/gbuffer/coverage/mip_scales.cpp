#include "passes/gbuffer/coverage/mip_scales.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "passes/reference/textures.h"

namespace strata::gbuffer {
namespace {

/// Alphas of a mip, largest first.
std::vector<double> sorted_alphas(const Texture& texture, std::uint32_t mip) {
    const std::uint32_t width = std::max(1u, texture.width >> mip), height = std::max(1u, texture.height >> mip);
    std::vector<double> alphas;
    alphas.reserve(std::size_t(width) * height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) alphas.push_back(texel(texture, mip, x, y).w);
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
