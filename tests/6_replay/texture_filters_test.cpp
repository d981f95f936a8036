// Filters of textures on the device, of opaque and of transparent surfaces: a card of 16 x 16 pixels whose texels are numbered.
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/texture.h"
#include "captures/cards.h"
#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::uint32_t card_pixels = 16;

/// One row that repeats, of `width` texels in the finest mip. Red of texel x in mip m.
float red_of_texel(std::uint32_t mip, std::uint32_t x) { return 0.125f * float(mip + 1) + 0.0625f * float(x % 2); }

Texture texel_row(std::uint32_t width) {
    Texture texture{.name = "row", .format = TextureFormat::rgba32f, .width = width, .height = 1, .mips = 0, .texels = {}};
    std::vector<glm::vec4> texels;
    for (std::uint32_t size = width; size > 0; size /= 2, ++texture.mips)
        for (std::uint32_t x = 0; x < size; ++x) texels.emplace_back(red_of_texel(texture.mips, x), 0, 0, 1);
    texture.texels.resize(texels.size() * sizeof(glm::vec4));
    std::memcpy(texture.texels.data(), texels.data(), texture.texels.size());
    return texture;
}

/// The pixels of a row of the card, whose u grows by `texels` texels of the finest mip per pixel from `first` on.
std::vector<double> shown_row(const Texture& texture, double texels, double first, AlphaMode alpha_mode) {
    Frame frame = frame_of_cards(std::array{Card{.half = 1, .alpha_mode = alpha_mode}}, card_pixels);
    const double width = texels * card_pixels / texture.width;
    for (const glm::vec3& at : frame.meshes[0].positions)
        frame.meshes[0].uv0.emplace_back(float(first / texture.width + width * double(0.5f + 0.5f * at.x)), 0.5f);
    frame.textures.push_back(texture);
    frame.materials[0].base_color_texture.texture = 0;
    const Request request{.choices = chosen({"transparency/alpha_blend"}), .outputs = {"color"}};
    const auto run = must(session_of_scenarios().run(frame, std::span(&request, 1))).front();
    const ReferenceImage color = in_double(run.images.at("color"));
    std::vector<double> row;
    for (std::uint32_t x = 0; x < card_pixels; ++x) row.push_back(color.at(x, 5).x);
    return row;
}

class TextureFilters : public testing::TestWithParam<AlphaMode> {};

TEST_P(TextureFilters, MagnifiedTexelsAreNearestOrMixed) {
    for (const TexelFilter filter : {TexelFilter::linear, TexelFilter::nearest}) {
        Texture texture = texel_row(4);
        texture.magnify = filter;
        const std::vector<double> row = shown_row(texture, 0.25, 0, GetParam());
        for (std::uint32_t x = 0; x < card_pixels; ++x) {
            const double at = (x + 0.5) * 0.25, left = std::floor(at - 0.5);
            const auto texel = [&](double i) { return double(red_of_texel(0, static_cast<std::uint32_t>(int(i) + 4))); };
            const double mixed = texel(left) + (at - 0.5 - left) * (texel(left + 1) - texel(left));
            const double wanted = filter == TexelFilter::nearest ? texel(std::floor(at)) : mixed;
            EXPECT_NEAR(row[x], wanted, 1e-4) << "pixel " << x << ", filter " << int(filter);
        }
    }
}

TEST_P(TextureFilters, MinifiedTexelsAreNearestOrMixed) {
    // Four texels per pixel: mip 2, of which texels 3/4 and 1/4 meet at each pixel's center.
    for (const TexelFilter filter : {TexelFilter::linear, TexelFilter::nearest}) {
        Texture texture = texel_row(64);
        texture.minify = filter;
        texture.between_mips = MipFilter::nearest;
        const std::vector<double> row = shown_row(texture, 4, 1, GetParam());
        for (std::uint32_t x = 0; x < card_pixels; ++x) {
            const double own = double(red_of_texel(2, x)), next = double(red_of_texel(2, x + 1));
            EXPECT_NEAR(row[x], filter == TexelFilter::nearest ? own : 0.75 * own + 0.25 * next, 1e-4)
                << "pixel " << x << ", filter " << int(filter);
        }
    }
}

TEST_P(TextureFilters, MipsAreMixedOrNearestOrNotRead) {
    // Three texels per pixel: level log2(3) = 1.585. The even pixels' centers lie on a texel's of mip 0.
    const double share = std::log2(3.0) - 1, below = 0.125 * 2, above = 0.125 * 3;
    const auto mean = [&](MipFilter filter) {
        Texture texture = texel_row(64);
        texture.between_mips = filter;
        const std::vector<double> row = shown_row(texture, 3, 0, GetParam());
        double sum = 0;
        for (const double red : row) sum += red / card_pixels;
        return sum;
    };
    // Over the row the alternation adds its mean, 1/32.
    EXPECT_NEAR(mean(MipFilter::linear), below + share * (above - below) + 0.03125, 2e-3);
    EXPECT_NEAR(mean(MipFilter::nearest), above + 0.03125, 2e-3);
    EXPECT_NEAR(mean(MipFilter::none), 0.125 + 0.03125, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, TextureFilters, testing::Values(AlphaMode::opaque, AlphaMode::blend),
                         [](const auto& tested) { return tested.param == AlphaMode::opaque ? "opaque" : "transparent"; });

}  // namespace
}  // namespace strata
