// Scales of alpha by mip: each mip keeps the finest one's share of texels.
#include "passes/gbuffer/coverage/mip_scales.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "capture_format/codec/texture_mips.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/frame/texture.h"
#include "captures/scenarios.h"
#include "passes/gbuffer/coverage/mask_tests.h"
#include "passes/reference/textures.h"

namespace strata::gbuffer {
namespace {

/// A frame of one masked material whose alpha is 255 or 0.
Frame masked_frame(std::uint32_t edge, bool (*is_there)(std::uint32_t x, std::uint32_t y)) {
    Frame frame;
    Texture texture{.width = edge, .height = edge};
    for (std::uint32_t y = 0; y < edge; ++y)
        for (std::uint32_t x = 0; x < edge; ++x)
            for (int c = 0; c < 4; ++c) texture.texels.push_back(std::byte(c < 3 || is_there(x, y) ? 255 : 0));
    frame.textures.push_back(with_mips(std::move(texture)));
    frame.materials.push_back({.alpha_mode = AlphaMode::mask});
    frame.materials[0].base_color_texture.texture = 0;
    return frame;
}

struct Shares {
    double share = 0;  ///< of texels that stay
    std::uint32_t texels = 0;
    std::uint32_t of_one_alpha = 0;  ///< the most texels with one alpha
};

Shares shares_of(const Texture& texture, std::uint32_t mip, double scale, double cutoff) {
    Shares shares;
    std::map<double, std::uint32_t> alphas;
    for (std::uint32_t y = 0; y < std::max(1u, texture.height >> mip); ++y)
        for (std::uint32_t x = 0; x < std::max(1u, texture.width >> mip); ++x, ++shares.texels) {
            const double alpha = texel(texture, mip, x, y).w;
            shares.share += scale * alpha >= cutoff ? 1 : 0;
            shares.of_one_alpha = std::max(shares.of_one_alpha, ++alphas[alpha]);
        }
    shares.share /= shares.texels;
    return shares;
}

TEST(MipScales, KeepTheFinestMipsShareAsFarAsTexelsOfOneAlphaLetThem) {
    const Frame frame = (*find_scenario("fence_and_foliage"))->build(0, {});
    int materials = 0, mips = 0;
    for (const Material& material : frame.materials) {
        if (material.alpha_mode != AlphaMode::mask) continue;
        ++materials;
        const Texture& texture = frame.textures[material.base_color_texture.texture];
        const auto scales = mip_scales(frame, material);
        const double cutoff = material.mask_cutoff, wanted = shares_of(texture, 0, 1, cutoff).share;
        for (std::uint32_t mip = 0; mip < texture.mips; ++mip, ++mips) {
            const Shares got = shares_of(texture, mip, double(scales[mip]), cutoff);
            EXPECT_LE(std::abs(got.share - wanted), 0.5 * got.of_one_alpha / got.texels + 1e-12)
                << material.name << " mip " << mip;
            EXPECT_NEAR(scales[mip], mip_scale_model(frame, material, mip), 1e-6 * double(scales[mip]));
        }
        EXPECT_EQ(scales[0], 1) << "the finest mip is tested as it is";
        EXPECT_EQ(scales[15], scales[texture.mips - 1]);
    }
    EXPECT_EQ(materials, 4);
    EXPECT_EQ(mips, 4 * 8);
}

TEST(MipScales, OfAFenceThatThePlainTestLosesBringItBack) {
    // Wires two texels wide, 8 apart: mips from the third on have alphas below .5 alone.
    const Frame frame = masked_frame(64, [](std::uint32_t x, std::uint32_t) { return x % 8 < 2; });
    const auto scales = mip_scales(frame, frame.materials[0]);
    const Texture& texture = frame.textures[0];
    EXPECT_EQ(shares_of(texture, 0, 1, .5).share, .25);
    EXPECT_EQ(shares_of(texture, 1, double(scales[1]), .5).share, .25);
    EXPECT_EQ(shares_of(texture, 3, 1, .5).share, 0) << "what the plain test leaves";
    EXPECT_EQ(shares_of(texture, 2, double(scales[2]), .5).share, .5) << "every second texel has alpha .5: all of them or none";
}

TEST(MipScales, OfOneAlphaEverywhereKeepAllOrNothing) {
    const Frame frame = masked_frame(16, [](std::uint32_t x, std::uint32_t y) { return (x + y) % 2 == 0; });
    const auto scales = mip_scales(frame, frame.materials[0]);
    for (std::uint32_t mip = 1; mip < 5; ++mip) {
        const double share = shares_of(frame.textures[0], mip, double(scales[mip]), .5).share;
        EXPECT_EQ(share, 1) << "as near to a half as none, and more";
    }
}

TEST(MipScales, AreOneWhereNothingOrEverythingStays) {
    for (const float cutoff : {0.0f, 1.5f}) {
        Frame frame = masked_frame(16, [](std::uint32_t x, std::uint32_t) { return x % 2 == 0; });
        frame.materials[0].mask_cutoff = cutoff;
        for (const float scale : mip_scales(frame, frame.materials[0])) EXPECT_EQ(scale, 1);
    }
    Frame plain = masked_frame(16, [](std::uint32_t, std::uint32_t) { return true; });
    plain.materials[0].base_color_texture.texture = no_index;
    for (const float scale : mip_scales(plain, plain.materials[0])) EXPECT_EQ(scale, 1);
}

TEST(MipScales, CountTheMaterialsOwnAlpha) {
    Frame frame = masked_frame(64, [](std::uint32_t x, std::uint32_t) { return x % 8 < 2; });
    const auto plain = mip_scales(frame, frame.materials[0]);
    frame.materials[0].base_color.w = .5f;
    frame.materials[0].mask_cutoff = .25f;
    EXPECT_EQ(mip_scales(frame, frame.materials[0]), plain) << "half the alpha against half the cutoff";
}

}  // namespace
}  // namespace strata::gbuffer
