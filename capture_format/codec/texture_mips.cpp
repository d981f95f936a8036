#include "capture_format/codec/texture_mips.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <utility>

#include <glm/glm.hpp>

#include "capture_format/codec/texture_bytes.h"
#include "capture_format/srgb.h"

namespace strata {
namespace {

enum class Encoding { srgb, linear };

/// Linear value of each byte.
using ByteTable = std::array<float, 256>;

ByteTable byte_table(Encoding encoding) {
    ByteTable table;
    for (std::size_t i = 0; i < table.size(); ++i) {
        const float value = static_cast<float>(i) / 255.0f;
        table[i] = encoding == Encoding::srgb ? decode_srgb(value) : value;
    }
    return table;
}

/// A mip in linear floats.
struct Level {
    std::uint32_t width = 0, height = 0;
    std::vector<glm::vec4> texels;
};

/// The source texels under one target texel along one axis: at most 3, when the size is odd, with the share of each.
struct Footprint {
    std::uint32_t first = 0, count = 1;
    std::array<float, 3> weight{1, 0, 0};
};

/// Target texel i of n covers source texels [i s/n, (i+1) s/n).
Footprint footprint(std::uint32_t i, std::uint32_t n, std::uint32_t s) {
    const double width = static_cast<double>(s) / n, begin = i * width, end = begin + width;
    Footprint result{static_cast<std::uint32_t>(begin), 0, {0, 0, 0}};
    for (std::uint32_t j = result.first; j < s && j < end && result.count < 3; ++j) {
        const double share = (std::min(end, j + 1.0) - std::max(begin, static_cast<double>(j))) / width;
        result.weight[result.count++] = static_cast<float>(share);
    }
    return result;
}

/// The next mip; `texel(x, y)` reads this one.
template <typename ReadTexel>
Level halved(std::uint32_t width, std::uint32_t height, const ReadTexel& texel) {
    Level half{std::max(1u, width / 2), std::max(1u, height / 2), {}};
    half.texels.reserve(std::size_t{half.width} * half.height);
    for (std::uint32_t y = 0; y < half.height; ++y) {
        const Footprint rows = footprint(y, half.height, height);
        for (std::uint32_t x = 0; x < half.width; ++x) {
            const Footprint columns = footprint(x, half.width, width);
            glm::vec4 sum(0);
            for (std::uint32_t j = 0; j < rows.count; ++j) {
                for (std::uint32_t i = 0; i < columns.count; ++i) {
                    sum += rows.weight[j] * columns.weight[i] * texel(columns.first + i, rows.first + j);
                }
            }
            half.texels.push_back(sum);
        }
    }
    return half;
}

void append(std::vector<std::byte>& texels, const Level& level, Encoding encoding) {
    for (const glm::vec4& texel : level.texels) {
        for (int c = 0; c < 3; ++c) texels.push_back(unorm8(encoding == Encoding::srgb ? encode_srgb(texel[c]) : texel[c]));
        texels.push_back(unorm8(texel.w));
    }
}

[[maybe_unused]] bool is_rgba8(TextureFormat format) {
    return format == TextureFormat::rgba8_unorm || format == TextureFormat::rgba8_srgb;
}

}  // namespace

Texture with_mips(Texture finest) {
    assert(is_rgba8(finest.format) && finest.texels.size() == std::size_t{4} * finest.width * finest.height);
    const Encoding encoding = finest.format == TextureFormat::rgba8_srgb ? Encoding::srgb : Encoding::linear;
    const ByteTable color = byte_table(encoding), alpha = byte_table(Encoding::linear);
    const std::vector<std::byte> bytes = finest.texels;  // appending moves the original
    finest.mips = static_cast<std::uint32_t>(std::bit_width(std::max(finest.width, finest.height)));
    finest.texels.reserve(texture_bytes(finest));
    Level level;
    for (finest.mips = 1; std::max(finest.width, finest.height) >> finest.mips > 0; ++finest.mips) {
        if (finest.mips == 1) {
            level = halved(finest.width, finest.height, [&](std::uint32_t x, std::uint32_t y) {
                const std::byte* texel = &bytes[(std::size_t{y} * finest.width + x) * 4];
                const auto at = [&](int c) { return static_cast<std::size_t>(texel[c]); };
                return glm::vec4(color[at(0)], color[at(1)], color[at(2)], alpha[at(3)]);
            });
        } else {
            const Level finer = std::move(level);
            level = halved(finer.width, finer.height,
                           [&](std::uint32_t x, std::uint32_t y) { return finer.texels[std::size_t{y} * finer.width + x]; });
        }
        append(finest.texels, level, encoding);
    }
    return finest;
}

glm::vec4 mean_color(const Texture& texture) {
    assert(is_rgba8(texture.format) && texture.mips > 0 && texture.texels.size() >= 4);
    const ByteTable color = byte_table(texture.format == TextureFormat::rgba8_srgb ? Encoding::srgb : Encoding::linear);
    const std::byte* last = &texture.texels[texture.texels.size() - 4];  // the coarsest mip is one texel: the mean
    const auto at = [&](int c) { return static_cast<std::size_t>(last[c]); };
    return {color[at(0)], color[at(1)], color[at(2)], static_cast<float>(at(3)) / 255.0f};
}

}  // namespace strata
