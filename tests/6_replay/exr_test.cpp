// OpenEXR files: what is written is read back bit for bit, and what cannot be read is refused with a sentence.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/srgb.h"
#include "replay/images/exr_bytes.h"
#include "replay/images/image_io.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

std::filesystem::path file_of_this_test() {
    return std::filesystem::path(testing::TempDir()) /
           fmt::format("strata_{}.exr", testing::UnitTest::GetInstance()->current_test_info()->name());
}

/// Every byte another one; no NaN among them whose bits a copy might change.
HostImage numbered(Format format, std::uint32_t layers) {
    HostImage image{{.extent = {5, 3}, .format = format, .layers = layers}, {}};
    image.texels.resize(bytes(image.shape));
    for (std::size_t i = 0; i < image.texels.size(); ++i) image.texels[i] = static_cast<std::byte>(i * 7 % 120);
    return image;
}

TEST(Exr, WhatIsWrittenIsReadBitForBit) {
    for (const Format format : {Format::r16f, Format::rg16f, Format::rgba16f, Format::r32f, Format::rg32f, Format::rgba32f,
                                Format::r32ui, Format::rg32ui, Format::rgba32ui, Format::d32f}) {
        const HostImage one = numbered(format, 1), four = numbered(format, 4);
        must(write_exr(file_of_this_test(), {{"one", one}, {"four", four}}, {}));
        const auto read = must(read_exr(file_of_this_test()));
        ASSERT_EQ(read.size(), 2u) << row(format).name;
        EXPECT_EQ(hash_of(read.at("one")), hash_of(one)) << row(format).name;
        EXPECT_EQ(hash_of(read.at("four")), hash_of(four)) << row(format).name;
    }
    std::filesystem::remove(file_of_this_test());
}

TEST(Exr, SmallFormatsComeBackWider) {
    const HostImage bytes = numbered(Format::rgba8_unorm, 1);
    must(write_exr(file_of_this_test(), {{"bytes", bytes}}, {}));
    const HostImage read = must(read_exr(file_of_this_test())).at("bytes");
    EXPECT_EQ(read.shape.format, Format::rgba32f);
    EXPECT_NEAR(texel(read, 4, 2).y, texel(bytes, 4, 2).y, 1e-7);
    std::filesystem::remove(file_of_this_test());
}

/// As a picture and the shadow maps of its frame do: OpenEXR refused parts whose display windows differ.
TEST(Exr, ImagesOfSeveralExtentsShareAFile) {
    HostImage wide = numbered(Format::r32f, 1), high = wide;
    wide.shape.extent = {15, 1, 1};
    high.shape.extent = {1, 15, 1};
    const HostImage both = numbered(Format::rgba16f, 2);
    must(write_exr(file_of_this_test(), {{"a", wide}, {"b", high}, {"c", both}}, {}));
    const auto read = must(read_exr(file_of_this_test()));
    EXPECT_EQ(hash_of(read.at("a")), hash_of(wide));
    EXPECT_EQ(hash_of(read.at("b")), hash_of(high));
    EXPECT_EQ(hash_of(read.at("c")), hash_of(both));
    EXPECT_EQ(read.at("b").place, read.at("a").place);
    std::filesystem::remove(file_of_this_test());
}

TEST(Exr, AMissingFileIsAnError) {
    EXPECT_THAT(read_exr("/nowhere/a.exr"), FailsWith("image.cannot_read", Field("file", "/nowhere/a.exr")));
}

TEST(Exr, AFileCutShortIsAnErrorWhereverItIsCut) {
    const HostImage image = numbered(Format::rgba16f, 2);
    must(write_exr(file_of_this_test(), {{"image", image}}, {}));
    const auto whole = std::filesystem::file_size(file_of_this_test());
    for (auto size = whole - 1; size > 0; size = size * 7 / 8) {
        std::filesystem::resize_file(file_of_this_test(), size);
        ASSERT_THAT(read_exr(file_of_this_test()), FailsWith("image.cannot_read")) << size << " of " << whole;
    }
    std::filesystem::remove(file_of_this_test());
}

TEST(Exr, ALayerWithoutTheOnesBeforeItIsAnError) {
    const HostImage image = numbered(Format::r32f, 1);
    must(write_exr(file_of_this_test(), {{"depth.layer1", image}}, {}));
    EXPECT_THAT(read_exr(file_of_this_test()), FailsWith("image.layer_order", Field("part", "depth.layer1"), Field("layer", 0),
                                                         Field("image", "depth"), Field("file", file_of_this_test().string())));
    std::filesystem::remove(file_of_this_test());
}

TEST(Png, WhatIsWrittenIsReadByteForByte) {
    const auto path = std::filesystem::path(testing::TempDir()) / "strata_picture.png";
    for (const Extent extent : {Extent{1, 1, 1}, Extent{3, 5, 1}, Extent{200, 90, 1}}) {
        std::vector<std::byte> rgb(std::size_t{extent.width} * extent.height * 3);
        for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<std::byte>(i * i / 7);
        must(write_png(path, extent, rgb));
        const HostImage read = must(read_png(path));
        ASSERT_EQ(read.shape.extent, extent);
        for (std::size_t i = 0; i < rgb.size(); ++i) ASSERT_EQ(read.texels[i / 3 * 4 + i % 3], rgb[i]) << i;
    }
    std::filesystem::remove(path);
}

TEST(DisplayByte, IsTheNearestOfTheSrgbCurve) {
    for (int i = 0; i <= 100000; ++i) {
        const double light = i / 100000.;
        EXPECT_EQ(display_byte(light), unorm8(encode_srgb(light))) << light;
    }
    EXPECT_EQ(display_byte(-1), std::byte{0});
    EXPECT_EQ(display_byte(7), std::byte{255});
    EXPECT_EQ(display_byte(HUGE_VAL), std::byte{0});
    EXPECT_EQ(display_byte(std::nan("")), std::byte{0});
}

/// OpenEXR passes on what its threads throw as an exception of its own, with the text alone.
TEST(ExrBytes, TellALackOfMemoryFromOtherProblems) {
    const std::runtime_error of_thread("std::bad_alloc"), of_file("a channel has no name");
    ExrBytes bytes, starved;
    bytes.write("abc", 3);
    bytes.seekp(1);
    bytes.write("xyz", 3);
    EXPECT_EQ(bytes.tellp(), 4u);
    EXPECT_THROW(bytes.rethrow_lack_of_memory(of_thread), std::bad_alloc);
    EXPECT_NO_THROW(bytes.rethrow_lack_of_memory(of_file));
    EXPECT_EQ(bytes.take(), "axyz");
    starved.seekp(std::uint64_t{1} << 62);
    EXPECT_ANY_THROW(starved.write("abc", 3));
    EXPECT_THROW(starved.rethrow_lack_of_memory(of_file), std::bad_alloc);
    EXPECT_THROW(starved.take(), std::bad_alloc);
}

}  // namespace
}  // namespace strata
