// Why the textures of the reference can be believed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "passes/reference/shade.h"
#include "passes/reference/textures.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {
namespace {

Texture bytes_texture(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> red) {
    Texture texture;
    texture.width = width;
    texture.height = height;
    for (const std::uint8_t r : red) {
        for (const std::uint8_t channel : {r, std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{255}}) {
            texture.texels.push_back(static_cast<std::byte>(channel));
        }
    }
    return texture;
}

TEST(Textures, BilinearIsTheTexelAtItsCenterAndTheMeanBetween) {
    const Texture texture = bytes_texture(2, 2, {0, 255, 51, 102});
    EXPECT_DOUBLE_EQ(bilinear(texture, 0, {0.25, 0.25}).x, 0);
    EXPECT_DOUBLE_EQ(bilinear(texture, 0, {0.75, 0.25}).x, 1);
    EXPECT_DOUBLE_EQ(bilinear(texture, 0, {0.5, 0.25}).x, 0.5);
    EXPECT_DOUBLE_EQ(bilinear(texture, 0, {0.25, 0.5}).x, 0.1);
    EXPECT_DOUBLE_EQ(bilinear(texture, 0, {0.5, 0.5}).x, 0.4);
}

TEST(Textures, SrgbDecodesBeforeFiltering) {
    Texture texture = bytes_texture(2, 1, {0, 255});
    texture.format = TextureFormat::rgba8_srgb;
    EXPECT_DOUBLE_EQ(bilinear(texture, 0, {0.5, 0.5}).x, 0.5);
    EXPECT_NEAR(srgb_to_linear(188.0 / 255), 0.5029, 1e-4);
    EXPECT_NEAR(srgb_to_linear(0.04045), 0.0031308, 1e-7);
    EXPECT_DOUBLE_EQ(srgb_to_linear(1), 1);
}

TEST(Textures, AddressesWrapClampAndMirror) {
    Texture texture = bytes_texture(4, 1, {0, 51, 102, 153});
    const auto at = [&](AddressMode mode, double column) {
        texture.address = mode;
        return std::lround(bilinear(texture, 0, {(column + 0.5) / 4, 0.5}).x * 5);
    };
    EXPECT_EQ(at(AddressMode::repeat, -1), 3);
    EXPECT_EQ(at(AddressMode::repeat, 9), 1);
    EXPECT_EQ(at(AddressMode::clamp, -7), 0);
    EXPECT_EQ(at(AddressMode::clamp, 5), 3);
    EXPECT_EQ(at(AddressMode::mirror, -1), 0);
    EXPECT_EQ(at(AddressMode::mirror, -2), 1);
    EXPECT_EQ(at(AddressMode::mirror, 4), 3);
    EXPECT_EQ(at(AddressMode::mirror, 8), 0);
    EXPECT_EQ(at(AddressMode::clamp_repeat, 9), 3) << "the first is along u";
    EXPECT_EQ(at(AddressMode::mirror_clamp, -2), 1);
    EXPECT_EQ(at(AddressMode::repeat_mirror, -1), 3);
}

TEST(Textures, EveryFormatDecodes) {
    Texture texture;
    texture.width = texture.height = 1;
    texture.format = TextureFormat::rgba16f;
    const std::array<std::uint16_t, 4> halves = {0x3c00, 0xc000, 0x3555, 0x7bff};
    texture.texels.resize(8);
    std::memcpy(texture.texels.data(), halves.data(), 8);
    EXPECT_EQ(texel(texture, 0, 0, 0), glm::dvec4(1, -2, 0.333251953125, 65504));
    texture.format = TextureFormat::rgba32f;
    const std::array<float, 4> floats = {0.1f, -2, 3e20f, 0};
    texture.texels.resize(16);
    std::memcpy(texture.texels.data(), floats.data(), 16);
    EXPECT_EQ(texel(texture, 0, 0, 0), glm::dvec4(0.1f, -2, 3e20f, 0));
}

Texture three_mips() {
    Texture texture = bytes_texture(4, 4, std::vector<std::uint8_t>(16, 0));
    texture.mips = 3;
    const Texture mip1 = bytes_texture(2, 2, {102, 102, 102, 102}), mip2 = bytes_texture(1, 1, {255});
    texture.texels.insert(texture.texels.end(), mip1.texels.begin(), mip1.texels.end());
    texture.texels.insert(texture.texels.end(), mip2.texels.begin(), mip2.texels.end());
    return texture;
}

TEST(Textures, TheLevelOfDetailMixesMipsAndIsClamped) {
    const Texture texture = three_mips();
    EXPECT_DOUBLE_EQ(trilinear(texture, {0.3, 0.6}, -5).x, 0);
    EXPECT_DOUBLE_EQ(trilinear(texture, {0.3, 0.6}, 0.5).x, 0.2);
    EXPECT_DOUBLE_EQ(trilinear(texture, {0.3, 0.6}, 1).x, 0.4);
    EXPECT_DOUBLE_EQ(trilinear(texture, {0.3, 0.6}, 1.25).x, 0.55);
    EXPECT_DOUBLE_EQ(trilinear(texture, {0.3, 0.6}, 9).x, 1);
    EXPECT_DOUBLE_EQ(level_of_detail(texture, {0.5, 0}, {0, 0.25}), 1);
    EXPECT_DOUBLE_EQ(level_of_detail(texture, {0.75, 1}, {0, 0}), std::log2(5));
    EXPECT_DOUBLE_EQ(trilinear(texture, {0.3, 0.6}, level_of_detail(texture, {0, 0}, {0, 0})).x, 0);
}

TEST(Textures, TheNearestTexelIsTheOneThatHoldsTheCoordinate) {
    Texture texture = bytes_texture(4, 1, {0, 51, 102, 153});
    texture.magnify = TexelFilter::nearest;
    const auto at = [&](double column, double lod = 0) { return filtered(texture, {column / 4, 0.5}, lod).x * 5; };
    EXPECT_DOUBLE_EQ(at(1.001), 1);
    EXPECT_DOUBLE_EQ(at(1.999), 1);
    EXPECT_DOUBLE_EQ(at(-0.001), 3) << "it repeats";
    EXPECT_DOUBLE_EQ(at(1.75, 0.1), 1.25) << "minified, which is linear";
    texture.magnify = TexelFilter::linear;
    texture.minify = TexelFilter::nearest;
    EXPECT_DOUBLE_EQ(at(1.75), 1.25) << "magnified";
    EXPECT_DOUBLE_EQ(at(1.75, 0.1), 1) << "also where there is one mip";
}

TEST(Textures, MipsAreMixedOrTheNearestOrTheFinest) {
    Texture texture = three_mips();  // 0, 0.4 and 1
    const auto at = [&](MipFilter filter, double lod) {
        texture.between_mips = filter;
        return filtered(texture, {0.3, 0.6}, lod).x;
    };
    for (const TexelFilter minify : {TexelFilter::linear, TexelFilter::nearest}) {
        texture.minify = minify;
        EXPECT_DOUBLE_EQ(at(MipFilter::linear, 0.5), 0.2);
        EXPECT_DOUBLE_EQ(at(MipFilter::linear, 1.25), 0.55);
        EXPECT_DOUBLE_EQ(at(MipFilter::nearest, 0.5), 0) << "Vulkan: half way the finer one";
        EXPECT_DOUBLE_EQ(at(MipFilter::nearest, 0.6), 0.4);
        EXPECT_DOUBLE_EQ(at(MipFilter::nearest, 9), 1);
        EXPECT_DOUBLE_EQ(at(MipFilter::none, 2), 0);
    }
}

TEST(Textures, ASurfaceChoosesItsMipFromTheUvChangePerPixel) {
    // A quad of 16 pixels with 2^n texels per pixel: uv runs 4 * 2^n times over it.
    for (int lod = 0; lod <= 2; ++lod) {
        Frame frame = tiny::frame(16, 16);
        frame.textures.push_back(three_mips());
        const std::uint32_t draw = tiny::add_quad(frame, {.left = 0, .top = 0, .right = 16, .bottom = 16}, 2);
        TextureUse& use = tiny::material(frame, draw).base_color_texture;
        use.texture = 0;
        use.transform = {4.0f * static_cast<float>(1 << lod), 0, 0.3f, 0, 1, 0};
        for (const glm::uvec2 pixel : {glm::uvec2(4, 7), glm::uvec2(5, 8)}) {
            const RasterPoint point = visible_points(frame, opaque_draws(frame)).at(pixel.x, pixel.y);
            EXPECT_NEAR(surface_at(frame, point).base_color.x, lod == 0 ? 0 : lod == 1 ? 0.4 : 1, 1e-5);
        }
    }
}

TEST(Textures, AParticlesCellHasItsTopAtTheTopOfTheScreen) {
    Frame frame = tiny::frame(16, 16);
    frame.textures.push_back(bytes_texture(2, 2, {0, 255, 51, 102}));
    frame.textures[0].address = AddressMode::clamp;
    Emitter emitter;
    emitter.texture = 0;
    Particle particle;
    particle.center = {0, 0, 1};
    emitter.particles = {particle};
    frame.emitters = {emitter};
    const FragmentLists lists = transparent_fragments(frame, tiny::no_depth(frame));
    EXPECT_NEAR(lists.at(0, 0)[0].color.x, 0, 1e-12);
    EXPECT_NEAR(lists.at(15, 0)[0].color.x, 1, 1e-12);
    EXPECT_NEAR(lists.at(0, 15)[0].color.x, 0.2, 1e-12);
    EXPECT_NEAR(lists.at(15, 15)[0].color.x, 0.4, 1e-12);
}

}  // namespace
}  // namespace strata
