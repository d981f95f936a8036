// Light that a run could not hold is found, counted and told by the pass that leaves it.
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "replay/session/light_check.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// One texel after the other, as floats.
HostImage image_of(Format format, const std::vector<glm::vec4>& texels) {
    HostImage image{.shape = {.extent = {static_cast<std::uint32_t>(texels.size()), 1, 1}, .format = format}};
    image.texels.resize(texels.size() * sizeof(glm::vec4));
    std::memcpy(image.texels.data(), texels.data(), image.texels.size());
    return image;
}

/// Halves by their bits.
HostImage halves_of(const std::vector<std::array<std::uint16_t, 4>>& texels) {
    HostImage image{.shape = {.extent = {static_cast<std::uint32_t>(texels.size()), 1, 1}, .format = Format::rgba16f}};
    image.texels.resize(texels.size() * sizeof texels.front());
    std::memcpy(image.texels.data(), texels.data(), image.texels.size());
    return image;
}

Frame lit_by(float irradiance, float white = 1.7f) {
    Frame frame = scenario_frames("three_cards").front();
    frame.view.width /= 4;
    frame.view.height /= 4;
    frame.view.exposure = 1;
    frame.film.white = white;
    frame.sun.irradiance = glm::vec3(irradiance);
    return frame;
}

std::vector<LightFault> faults_of(const Frame& frame) {
    return must(session_of({frame})->run({.light = LightCheck::on})).light_faults;
}

}  // namespace

TEST(LightCheck, CountsTexelsThatAreNoNumber) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const auto faults = light_faults(
        "color", image_of(Format::rgba32f, {{1, 1, 1, 1}, {0, nan, 0, 1}, {1e30f, 0, 0, nan}, {infinity, 0, 0, 0}}), 1);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].kind, LightFault::Kind::not_finite);
    EXPECT_EQ(faults[0].texels, 2u) << "alpha is no light, and floats have no limit";
    EXPECT_EQ(faults[0].first, glm::uvec2(1, 0));
    EXPECT_TRUE(light_faults("surface_normal", image_of(Format::rgba32f, {{nan, 0, 0, 0}}), 1).empty()) << "no light";
}

/// 0x7bff is 65504, 0x7bfe 65472, 0x7c00 infinity, 0xfbff -65504.
TEST(LightCheck, CountsHalvesAtTheirLimitInTheRecordedUnit) {
    const auto faults =
        light_faults("light", halves_of({{0x7bfe, 0, 0, 0}, {0x7bff, 0, 0, 0}, {0, 0xfbff, 0, 0}, {0x7c00, 0x7bff, 0, 0}}), .25);
    ASSERT_EQ(faults.size(), 2u);
    EXPECT_EQ(faults[0].texels, 1u) << "infinity is no number";
    EXPECT_EQ(faults[1].kind, LightFault::Kind::cut_off);
    EXPECT_EQ(faults[1].texels, 2u);
    EXPECT_EQ(faults[1].limit, 4 * 65504);
    EXPECT_EQ(faults[1].first, glm::uvec2(1, 0));
}

TEST(LightCheck, FindsNothingInAFrameThatFits) {
    EXPECT_THAT(faults_of(lit_by(3)), testing::IsEmpty());
    EXPECT_THAT(faults_of(lit_by(1e5f)), testing::IsEmpty()) << "a sun in lux";
}

/// A tone curve whose white is 1e-38: x / white^2 is no number.
TEST(LightCheck, NamesThePassThatLeavesNoNumbers) {
    const auto faults = faults_of(lit_by(3, 1e-38f));
    ASSERT_FALSE(faults.empty());
    EXPECT_EQ(faults.back().image, "display");
    EXPECT_GT(faults.back().texels, 0u);
    EXPECT_THAT(sentence(faults.back()), testing::HasSubstr("'display'"));
}

}  // namespace strata
