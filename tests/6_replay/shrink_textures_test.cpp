// Textures that exceed what a device binds.
#include <gtest/gtest.h>

#include "capture_format/codec/texture_bytes.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/texture.h"
#include "replay/scene/shrink_textures.h"

namespace strata {
namespace {

/// A square texture with all its mips; the texels of mip m are all m.
Texture pyramid(std::uint32_t edge) {
    Texture t{.name = "pyramid", .width = edge, .height = edge, .mips = 0};
    for (std::uint32_t size = edge; size > 0; size /= 2, ++t.mips)
        t.texels.resize(t.texels.size() + std::size_t{4} * size * size, std::byte(t.mips));
    return t;
}

TEST(FitTextures, WhatFitsIsLeftAlone) {
    Frame frame;
    frame.textures = {pyramid(8)};
    EXPECT_TRUE(shrink_textures(frame, texture_bytes(frame.textures[0])).empty());
    EXPECT_EQ(frame.textures[0].width, 8u);
}

TEST(FitTextures, TheLargestLosesItsFinestMipsFirstAndASentenceSaysSo) {
    Frame frame;
    frame.textures = {pyramid(4), pyramid(16)};
    const auto notes = shrink_textures(frame, texture_bytes(pyramid(4)) + texture_bytes(pyramid(8)));
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("without its 1 finest"), std::string::npos);
    EXPECT_EQ(frame.textures[0].width, 4u);
    EXPECT_EQ(frame.textures[1].width, 8u);
    EXPECT_EQ(frame.textures[1].mips, 4u);
    EXPECT_EQ(frame.textures[1].texels.front(), std::byte{1});
    EXPECT_EQ(frame.textures[1].texels.size(), texture_bytes(frame.textures[1]));
}

TEST(FitTextures, TheCoarsestMipAlwaysStays) {
    Frame frame;
    frame.textures = {pyramid(8)};
    EXPECT_EQ(shrink_textures(frame, 0).size(), 1u);
    EXPECT_EQ(frame.textures[0].mips, 1u);
    EXPECT_EQ(frame.textures[0].texels.size(), 4u);
}

}  // namespace
}  // namespace strata
