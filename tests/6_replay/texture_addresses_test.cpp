// Textures beyond their edges on the device: a card on which every texel covers one pixel, so each pixel shows one texel.
#include <array>
#include <cstring>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/texture.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::uint32_t texels_across = 4, pixels_across = 16;

float shade_of(std::uint32_t texel) { return 0.2f * float(texel + 1); }

/// Red says which column a texel is in, green which row.
Texture numbered(AddressMode address) {
    std::vector<glm::vec4> colors;
    for (std::uint32_t y = 0; y < texels_across; ++y)
        for (std::uint32_t x = 0; x < texels_across; ++x) colors.emplace_back(shade_of(x), shade_of(y), 0, 1);
    Texture texture{.name = "numbered",
                    .format = TextureFormat::rgba32f,
                    .width = texels_across,
                    .height = texels_across,
                    .address = address};
    texture.texels.resize(colors.size() * sizeof(glm::vec4));
    std::memcpy(texture.texels.data(), colors.data(), texture.texels.size());
    return texture;
}

/// Texels -4 to 11 each way over the 16 x 16 pixels.
Frame textured_card(AddressMode address) {
    Frame frame = frame_of_cards(std::array{Card{.half = 1}}, pixels_across);
    for (const glm::vec3& at : frame.meshes[0].positions) frame.meshes[0].uv0.emplace_back(2 * at.x + 1, 1 - 2 * at.y);
    frame.textures.push_back(numbered(address));
    frame.materials[0].base_color_texture.texture = 0;
    return frame;
}

TEST(TextureAddresses, RepeatClampAndMirrorAcrossAndDown) {
    // The texel at each pixel, from the left or from the top, of repeat, clamp and mirror.
    constexpr std::string_view shown[] = {"0123012301230123", "0000012333333333", "3210012332100123"};
    for (std::uint32_t mode = 0; mode <= static_cast<std::uint32_t>(AddressMode::mirror_clamp); ++mode) {
        const AddressMode address{mode};
        const Request request{.choices = chosen({"transparency/alpha_blend"}), .outputs = {"color"}};
        const auto run = must(session_of_scenarios().run(textured_card(address), std::span(&request, 1))).front();
        const ReferenceImage color = in_double(run.images.at("color"));
        const auto texel = [&](AddressMode along, std::uint32_t at) {
            return double(shade_of(std::uint32_t(shown[static_cast<std::size_t>(along)][at] - '0')));
        };
        for (std::uint32_t y = 0; y < pixels_across; ++y)
            for (std::uint32_t x = 0; x < pixels_across; ++x) {
                ASSERT_NEAR(color.at(x, y).x, texel(address_u(address), x), 1e-4) << mode << " at " << x << ", " << y;
                ASSERT_NEAR(color.at(x, y).y, texel(address_v(address), y), 1e-4) << mode << " at " << x << ", " << y;
            }
    }
}

}  // namespace
}  // namespace strata
