// Texels of every format in double.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "replay/images/host_image.h"

namespace strata {
namespace {

template <typename... Words>
HostImage image_of(Format format, Words... words) {
    HostImage image{{.format = format}, {}};
    const auto append = [&](auto word) {
        const std::size_t end = image.texels.size();
        image.texels.resize(end + sizeof word);
        std::memcpy(image.texels.data() + end, &word, sizeof word);
    };
    (append(words), ...);
    return image;
}

double half(std::uint16_t bits) { return texel(image_of(Format::r16f, bits), 0, 0).x; }

TEST(HostImage, ReadsHalves) {
    EXPECT_EQ(half(0x3c00), 1);
    EXPECT_EQ(half(0xc000), -2);
    EXPECT_EQ(half(0x7bff), 65504);
    EXPECT_EQ(half(0x0001), std::ldexp(1, -24));
    EXPECT_EQ(half(0x03ff), 1023 * std::ldexp(1, -24));
    EXPECT_EQ(half(0x7c00), HUGE_VAL);
    EXPECT_EQ(half(0xfc00), -HUGE_VAL);
    EXPECT_TRUE(std::isnan(half(0x7e00)));
    EXPECT_TRUE(std::signbit(half(0x8000)));
}

TEST(HostImage, ReadsPackedFloats) {
    // 1 is exponent 15: 15 << 6 in 11 bits, 15 << 5 in 10 bits; red lies lowest.
    const std::uint32_t one_two_three = 15u << 6 | (16u << 6) << 11 | (16u << 5 | 16u) << 22;
    EXPECT_EQ(texel(image_of(Format::r11g11b10f, one_two_three), 0, 0), glm::dvec4(1, 2, 3, 1));
}

TEST(HostImage, ReadsNormalizedAndWholeNumbers) {
    EXPECT_EQ(texel(image_of(Format::rgba8_unorm, std::uint32_t{0xff003300}), 0, 0), glm::dvec4(0, 0.2, 0, 1));
    EXPECT_EQ(texel(image_of(Format::r16_unorm, std::uint16_t{0xffff}), 0, 0), glm::dvec4(1, 0, 0, 1));
    EXPECT_EQ(texel(image_of(Format::rg32ui, 4000000000u, 1u), 0, 0), glm::dvec4(4e9, 1, 0, 1));
    EXPECT_EQ(texel(image_of(Format::d32f, 0.25f), 0, 0), glm::dvec4(0.25, 0, 0, 1));
}

TEST(HostImage, PutsLayersBehindEachOther) {
    HostImage image = image_of(Format::r8ui, std::uint32_t{0x04030201}, std::uint32_t{0x08070605});
    image.shape.extent = {2, 2};
    image.shape.layers = 2;
    const ReferenceImage all = in_double(image);
    EXPECT_EQ(all.layers, 2u);
    EXPECT_EQ(all.at(1, 0, 1).x, 6);
    EXPECT_EQ(all.at(0, 1, 0).x, 3);
}

}  // namespace
}  // namespace strata
