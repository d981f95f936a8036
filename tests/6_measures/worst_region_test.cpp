// Where pixels over a limit stand together: a small defect of a large picture against as many scattered pixels.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "replay/difference/compare_images.h"
#include "replay/measure/worst_region.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using testing::HasSubstr;

struct Map {
    std::uint32_t width, height;
    std::vector<bool> is_over = std::vector<bool>(std::size_t(width) * height);

    void fill(const PixelBox& box) {
        for (std::uint32_t y = box.y; y < box.y + box.height; ++y)
            for (std::uint32_t x = box.x; x < box.x + box.width; ++x) is_over[std::size_t(y) * width + x] = true;
    }
    /// So many pixels at places drawn at random.
    void scatter(std::size_t pixels) {
        std::mt19937 random(7);
        for (std::size_t made = 0; made < pixels;) {
            const std::size_t at = random() % is_over.size();
            made += is_over[at] ? 0 : 1;
            is_over[at] = true;
        }
    }
    std::optional<WorstRegion> worst() const { return worst_region(is_over, width, height); }
};

TEST(WorstRegion, IsTheBoxOfADefectWhereverItLies) {
    for (const PixelBox box : {PixelBox{1000, 700, 32, 32}, PixelBox{0, 0, 32, 32}, PixelBox{3808, 2128, 32, 32},
                               PixelBox{3839, 2159, 1, 1}, PixelBox{5, 11, 16, 100}}) {
        Map map{3840, 2160};
        map.fill(box);
        const auto found = map.worst();
        ASSERT_TRUE(found);
        EXPECT_EQ(found->box, box);
        EXPECT_EQ(found->density, 1);
        EXPECT_EQ(found->pixels, std::uint64_t{box.width} * box.height);
        EXPECT_EQ(found->block_density, std::min(box.width, 16u) * std::min(box.height, 16u) / 256.);
    }
}

/// 1,024 of 8.3 million pixels: the mean is that of a defect of 32 x 32.
TEST(WorstRegion, OfScatteredPixelsIsSparse) {
    Map map{3840, 2160};
    map.scatter(1024);
    EXPECT_LT(map.worst()->block_density, .02);
    map.fill({200, 300, 32, 32});
    EXPECT_EQ(map.worst()->block_density, 1);
    EXPECT_NEAR(map.worst()->box.x, 200, 16);
    EXPECT_NEAR(map.worst()->box.width, 32, 16);
}

TEST(WorstRegion, BlockIsTheDensestOfAll) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 40; ++trial) {
        Map map{std::uint32_t(1 + random() % 70), std::uint32_t(1 + random() % 70)};
        for (std::size_t i = 0; i < map.is_over.size(); ++i) map.is_over[i] = random() % 5 == 0;
        double densest = 0;
        const std::uint32_t w = std::min(16u, map.width), h = std::min(16u, map.height);
        for (std::uint32_t top = 0; top + h <= map.height; ++top)
            for (std::uint32_t left = 0; left + w <= map.width; ++left) {
                int over = 0;
                for (std::uint32_t y = top; y < top + h; ++y)
                    for (std::uint32_t x = left; x < left + w; ++x) over += map.is_over[std::size_t(y) * map.width + x];
                densest = std::max(densest, over / double(w * h));
            }
        const auto found = map.worst();
        EXPECT_DOUBLE_EQ(found ? found->block_density : 0, densest) << map.width << " x " << map.height;
    }
    EXPECT_FALSE(Map(9, 9).worst());
    EXPECT_FALSE(worst_region({}, 0, 0));
}

HostImage gray(std::uint32_t width, std::uint32_t height, float value) {
    HostImage image{.shape = {.extent = {width, height, 1}, .format = Format::r32f}};
    image.texels.resize(std::size_t(width) * height * sizeof value);
    for (std::size_t i = 0; i < std::size_t(width) * height; ++i) std::memcpy(image.texels.data() + 4 * i, &value, sizeof value);
    return image;
}

void set(HostImage& image, const PixelBox& box, float value) {
    for (std::uint32_t y = box.y; y < box.y + box.height; ++y)
        for (std::uint32_t x = box.x; x < box.x + box.width; ++x)
            std::memcpy(image.texels.data() + 4 * (std::size_t(y) * image.shape.extent.width + x), &value, sizeof value);
}

TEST(RegionLimit, RefusesADefectThatAPercentageAllows) {
    const HostImage a = gray(640, 360, 0);
    HostImage defect = a, noise = a;
    set(defect, {400, 100, 32, 32}, .5f);
    std::mt19937 random(5);
    for (int i = 0; i < 1024; ++i) set(noise, {std::uint32_t(random() % 640), std::uint32_t(random() % 360), 1, 1}, .5f);
    const ErrorLimits limits{.limit = .1, .percent = 1, .region = 25};
    EXPECT_EQ(must(compare_images("a", a, noise, limits)).verdict, Verdict::within);
    const ImageComparison made = must(compare_images("a", a, defect, limits));
    EXPECT_EQ(made.verdict, Verdict::over);
    EXPECT_THAT(made.reason, HasSubstr("percent of a 16 x 16 block over 0.1: 100, allowed 25; densest in 32 x 32 pixels at (400, "
                                       "100), 100 % of them over; "));
    EXPECT_EQ(must(compare_images("a", a, defect, {.limit = .1, .percent = 1})).verdict, Verdict::within);
}

TEST(IgnoredPixels, TakePartInNoFigure) {
    const HostImage a = gray(64, 32, 1);
    HostImage b = a;
    set(b, {8, 8, 10, 10}, NAN);
    ErrorLimits limits;
    limits.ignored.boxes = {{8, 8, 10, 9}, {0, 0, 0, 0}};
    const ImageComparison made = must(compare_images("a", a, b, limits));
    EXPECT_EQ(made.verdict, Verdict::over);
    EXPECT_EQ(made.error.disagreeing, 10u) << "the last row of the box is not ignored";
    EXPECT_EQ(made.error.ignored, 90u);
    EXPECT_EQ(made.error.region->box, (PixelBox{8, 17, 10, 1}));
    limits.ignored.boxes.push_back({8, 17, 10, 1});
    EXPECT_EQ(must(compare_images("a", a, b, limits)).verdict, Verdict::within);
    EXPECT_EQ(must(compare_images("a", a, b, limits)).error.rmse, 0);
    limits.ignored.boxes = {{0, 0, 64, 32}};
    EXPECT_EQ(compare_images("a", a, b, limits).error().id, "diff.all_ignored");
    limits.ignored = {.boxes = {}, .mask = std::vector<bool>(64 * 32), .mask_width = 64, .mask_height = 32};
    for (std::size_t i = 0; i < limits.ignored.mask.size(); ++i) limits.ignored.mask[i] = i % 64 < 18;
    EXPECT_EQ(must(compare_images("a", a, b, limits)).verdict, Verdict::within);
    EXPECT_EQ(compare_images("a", gray(32, 32, 1), gray(32, 32, 1), limits).error().id, "diff.mask_size");
}

/// FLIP looks at a neighborhood: what is ignored must not show beside its box.
TEST(IgnoredPixels, AreNotSeenByFlipEither) {
    HostImage a{.shape = {.extent = {64, 64, 1}, .format = Format::rgba8_unorm}, .texels = std::vector<std::byte>(4 * 64 * 64)};
    for (std::size_t i = 0; i < a.texels.size(); ++i) a.texels[i] = std::byte(i % 4 == 3 ? 255 : i % 251);
    HostImage b = a;
    for (std::size_t y = 20; y < 40; ++y)
        for (std::size_t x = 20; x < 40; ++x)
            for (std::size_t c = 0; c < 3; ++c) b.texels[4 * (64 * y + x) + c] ^= std::byte{255};
    ErrorLimits limits{.flip_mean = 0};
    EXPECT_GT(must(compare_images("image", a, b, limits)).flip->mean, .01);
    limits.ignored.boxes = {{20, 20, 20, 20}};
    EXPECT_EQ(must(compare_images("image", a, b, limits)).flip->mean, 0);
    EXPECT_EQ(must(compare_images("image", a, b, limits)).verdict, Verdict::within);
}

}  // namespace
}  // namespace strata
