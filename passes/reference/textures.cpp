// Filtering from the definition: no tables but those of what a byte stands for.
#include "passes/reference/textures.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "capture_format/frame/material.h"
#include "capture_format/frame/texture.h"

namespace strata {
namespace {

std::size_t texel_bytes(TextureFormat format) {
    switch (format) {
        case TextureFormat::rgba16f:
            return 8;
        case TextureFormat::rgba32f:
            return 16;
        default:
            return 4;
    }
}

std::uint32_t mip_size(std::uint32_t size, std::uint32_t mip) { return std::max(1u, size >> mip); }

// Texels before a mip: mips follow each other, finest first.
std::size_t mip_offset(const Texture& texture, std::uint32_t mip) {
    std::size_t texels = 0;
    for (std::uint32_t m = 0; m < mip; ++m) texels += std::size_t(mip_size(texture.width, m)) * mip_size(texture.height, m);
    return texels;
}

std::uint32_t wrapped(std::int64_t index, std::uint32_t size, AddressMode mode) {
    const std::int64_t n = size;
    if (index >= 0 && index < n) return static_cast<std::uint32_t>(index);  // as nearly all are, and divisions are slow
    if (mode == AddressMode::clamp) return static_cast<std::uint32_t>(std::clamp<std::int64_t>(index, 0, n - 1));
    const std::int64_t period = mode == AddressMode::mirror ? 2 * n : n;
    std::int64_t within = index % period;
    if (within < 0) within += period;
    return static_cast<std::uint32_t>(within < n ? within : period - 1 - within);
}

// A coordinate in texels, kept where its floor fits an integer; what is not finite reads the first texel.
double bounded(double texels) { return std::isfinite(texels) ? std::clamp(texels, -1e15, 1e15) : 0.0; }

}  // namespace

double srgb_to_linear(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

double linear_to_srgb(double linear) { return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055; }

namespace {

/// What bytes stand for.
struct ByteValues {
    std::array<double, 256> unorm, srgb;
    ByteValues() {
        for (std::size_t i = 0; i < unorm.size(); ++i) unorm[i] = double(i) / 255, srgb[i] = srgb_to_linear(unorm[i]);
    }
};

glm::dvec4 texel_at(const Texture& texture, std::size_t index) {
    static const ByteValues values;
    const std::byte* bytes = texture.texels.data() + index * texel_bytes(texture.format);
    if (texture.format == TextureFormat::rgba32f) {
        std::array<float, 4> v;
        std::memcpy(v.data(), bytes, sizeof v);
        return {v[0], v[1], v[2], v[3]};
    }
    if (texture.format == TextureFormat::rgba16f) {
        std::array<std::uint16_t, 4> v;
        std::memcpy(v.data(), bytes, sizeof v);
        return {glm::unpackHalf1x16(v[0]), glm::unpackHalf1x16(v[1]), glm::unpackHalf1x16(v[2]), glm::unpackHalf1x16(v[3])};
    }
    const auto byte = [&](std::size_t i) { return std::to_integer<std::size_t>(bytes[i]); };
    const auto& color = texture.format == TextureFormat::rgba8_srgb ? values.srgb : values.unorm;
    return {color[byte(0)], color[byte(1)], color[byte(2)], values.unorm[byte(3)]};
}

}  // namespace

glm::dvec4 texel(const Texture& texture, std::uint32_t mip, std::uint32_t x, std::uint32_t y) {
    return texel_at(texture, mip_offset(texture, mip) + std::size_t(y) * mip_size(texture.width, mip) + x);
}

namespace {

/// Two taps mixed by the fraction of the mip, which is one of the texture's.
template <typename Tap>
glm::dvec4 over_mips(double mip, const Tap& tap) {
    const auto fine = static_cast<std::uint32_t>(mip);
    const glm::dvec4 first = tap(fine);
    return mip == fine ? first : glm::mix(first, tap(fine + 1), mip - fine);
}

/// The texel that holds uv.
glm::dvec4 nearest(const Texture& texture, std::uint32_t mip, const glm::dvec2& uv) {
    const std::uint32_t width = mip_size(texture.width, mip), height = mip_size(texture.height, mip);
    const auto place = [](double texels) { return static_cast<std::int64_t>(std::floor(bounded(texels))); };
    return texel(texture, mip, wrapped(place(uv.x * width), width, address_u(texture.address)),
                 wrapped(place(uv.y * height), height, address_v(texture.address)));
}

}  // namespace

glm::dvec4 bilinear(const Texture& texture, std::uint32_t mip, const glm::dvec2& uv) {
    const std::uint32_t width = mip_size(texture.width, mip), height = mip_size(texture.height, mip);
    const double u = bounded(uv.x * width - 0.5), v = bounded(uv.y * height - 0.5);
    const double left = std::floor(u), top = std::floor(v), right_share = u - left, bottom_share = v - top;
    const AddressMode across = address_u(texture.address), down = address_v(texture.address);
    const auto column = [&](int step) { return wrapped(static_cast<std::int64_t>(left) + step, width, across); };
    const auto row = [&](int step) { return wrapped(static_cast<std::int64_t>(top) + step, height, down); };
    const std::uint32_t x0 = column(0), x1 = column(1);
    const std::size_t first = mip_offset(texture, mip);
    const std::size_t y0 = first + std::size_t(row(0)) * width, y1 = first + std::size_t(row(1)) * width;
    const glm::dvec4 upper = glm::mix(texel_at(texture, y0 + x0), texel_at(texture, y0 + x1), right_share);
    const glm::dvec4 lower = glm::mix(texel_at(texture, y1 + x0), texel_at(texture, y1 + x1), right_share);
    return glm::mix(upper, lower, bottom_share);
}

glm::dvec4 trilinear(const Texture& texture, const glm::dvec2& uv, double lod) {
    const double clamped = std::isnan(lod) ? 0 : std::clamp(lod, 0.0, double(texture.mips - 1));
    return over_mips(clamped, [&](std::uint32_t mip) { return bilinear(texture, mip, uv); });
}

glm::dvec4 filtered(const Texture& texture, const glm::dvec2& uv, double lod) {
    const double level = std::isnan(lod) ? 0 : lod;
    const double last = texture.mips - 1.0;
    double mip = std::clamp(level, 0.0, last);
    if (texture.between_mips == MipFilter::none) mip = 0;
    if (texture.between_mips == MipFilter::nearest) mip = std::ceil(mip - 0.5);
    if ((level > 0 ? texture.minify : texture.magnify) == TexelFilter::linear) return trilinear(texture, uv, mip);
    return over_mips(mip, [&](std::uint32_t one) { return nearest(texture, one, uv); });
}

double level_of_detail(const Texture& texture, const glm::dvec2& uv_per_x, const glm::dvec2& uv_per_y) {
    const glm::dvec2 size(texture.width, texture.height);
    const glm::dvec2 along_x = uv_per_x * size, along_y = uv_per_y * size;
    return std::log2(std::sqrt(std::max(glm::dot(along_x, along_x), glm::dot(along_y, along_y))));
}

glm::dvec2 transformed(const TextureUse& use, const glm::dvec2& uv) {
    const auto& t = use.transform;
    return {t[0] * uv.x + t[1] * uv.y + t[2], t[3] * uv.x + t[4] * uv.y + t[5]};
}

}  // namespace strata
