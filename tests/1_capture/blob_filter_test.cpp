// Blobs rearranged before they are compressed: to the bit what they were, and smaller.
#include "capture_format/container/blob_filter.h"

#include <cmath>
#include <cstring>
#include <random>

#include <gmock/gmock.h>
#include <zstd.h>

#include "capture_format/container/ray_records.h"
#include "tests/1_capture/temporary_file.h"

namespace strata {
namespace {

template <typename T>
std::vector<std::byte> blob_of(const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return {bytes.begin(), bytes.end()};
}

std::size_t packed_bytes(std::span<const std::byte> bytes) {
    std::vector<std::byte> packed(ZSTD_compressBound(bytes.size()));
    return ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3);
}

/// Expects the blob to come back, and returns how it was filtered.
FilteredBlob sound(const std::vector<std::byte>& blob, std::size_t element_bytes) {
    FilteredBlob result = filtered(blob, element_bytes).value_or(FilteredBlob{{}, blob});
    std::vector<std::byte> undone(blob.size());
    EXPECT_TRUE(undo_filter(result.bytes, result.filter, undone));
    EXPECT_EQ(undone, blob);
    return result;
}

/// 0, 1, 2 ... as a mesh of triangles without shared corners has them.
std::vector<std::byte> counted(std::uint32_t count) {
    std::vector<std::uint32_t> values(count);
    for (std::uint32_t i = 0; i < count; ++i) values[i] = i;
    return blob_of(values);
}

/// Corners of triangles that each lie at one depth, on the rays of a grid of pixels: what a deep image becomes.
std::vector<std::byte> deep_positions(std::size_t pixels, std::size_t each) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> depth(1, 1000);
    std::vector<float> values;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        for (std::size_t sample = 0; sample < each; ++sample) {
            const float z = depth(random);
            for (const double corner : {.2512, .5913, .8604})
                for (const double value : {(double(pixel) + corner) / 7.0 * double(z), -corner / 3.0 * double(z), double(z)})
                    values.push_back(static_cast<float>(value));
        }
    return blob_of(values);
}

TEST(BlobFilter, IndicesThatCountUpTakeAlmostNothing) {
    const auto blob = counted(30000);
    const FilteredBlob result = sound(blob, 4);
    EXPECT_GT(packed_bytes(blob), blob.size() / 4);
    EXPECT_LT(packed_bytes(result.bytes), 200u);
}

TEST(BlobFilter, HalvesStoredAsFloatsTakeTheRoomOfHalves) {
    std::mt19937 random(1);
    std::vector<float> values(30000);
    for (float& value : values) value = std::ldexp(float(1024 + random() % 1024), -10);  // 11 significant bits, as a half has
    const FilteredBlob result = sound(blob_of(values), 4);
    EXPECT_LT(packed_bytes(result.bytes), values.size() * 2);
}

TEST(BlobFilter, AllSizesComeBack) {
    std::mt19937 random(1);
    for (const std::size_t words : {1u, 1023u, 1024u, 1025u, 3071u, 3072u, 9999u})
        for (const std::size_t element : {1u, 2u, 4u, 8u, 12u, 16u, 48u, 68u}) {
            std::vector<std::uint32_t> values(words);
            for (std::uint32_t& value : values) value = static_cast<std::uint32_t>(random() % 5000);
            sound(blob_of(values), element);
        }
}

TEST(BlobFilter, NoiseAndSmallBlobsStayAsTheyAre) {
    std::mt19937 random(1);
    std::vector<std::uint32_t> noise(10000);
    for (std::uint32_t& value : noise) value = static_cast<std::uint32_t>(random());
    EXPECT_EQ(sound(blob_of(noise), 4).filter, BlobFilter{});
    EXPECT_EQ(sound(counted(1000), 4).filter, BlobFilter{});
    EXPECT_EQ(sound(counted(30000), 1).filter, BlobFilter{}) << "nothing is known of its elements";
}

TEST(BlobFilter, PositionsOnRaysTakeLittleMoreThanTheirDepths) {
    const auto blob = deep_positions(500, 20);
    const FilteredBlob result = sound(blob, position_bytes);
    EXPECT_EQ(result.filter.shape, BlobShape::ray_records);
    constexpr std::size_t samples = 500 * 20, depth_bytes = 4;
    EXPECT_LT(packed_bytes(result.bytes), samples * depth_bytes * 5 / 4);
    EXPECT_GT(packed_bytes(blob), samples * depth_bytes * 4);
}

TEST(BlobFilter, OnePositionThatIsOffItsRayIsKeptToTheBit) {
    auto blob = deep_positions(500, 20);
    blob[position_bytes * 1000] ^= std::byte{1};
    sound(blob, position_bytes);
}

TEST(RayRecords, ThereAreNoneBehindTheEyeOrOffTheRays) {
    const std::vector<float> behind = {1, 1, -1, 1, 2, -1, 2, 1, -1}, slanted = {1, 1, 1, 1, 2, 1, 2, 1, 2};
    EXPECT_FALSE(ray_records(blob_of(behind)));
    EXPECT_FALSE(ray_records(blob_of(slanted)));
    std::mt19937 random(1);
    std::uniform_real_distribution<float> anywhere(1, 2);
    std::vector<float> cloud(30000, 1.5f);  // at one depth, but anywhere
    for (std::size_t i = 0; i < cloud.size(); ++i)
        if (i % 3 != 2) cloud[i] = anywhere(random);
    EXPECT_FALSE(ray_records(blob_of(cloud)));
}

TEST(BlobFilter, WhatNoFilterLeftIsRefused) {
    const auto blob = deep_positions(500, 20);
    const FilteredBlob good = filtered(blob, position_bytes).value();
    ASSERT_EQ(good.filter.shape, BlobShape::ray_records);
    std::vector<std::byte> undone(blob.size());
    const auto refused = [&](std::vector<std::byte> bytes, BlobFilter filter) {
        EXPECT_FALSE(undo_filter(bytes, filter, undone));
    };
    for (const BlobFilter unknown :
         {BlobFilter{static_cast<BlobShape>(2), 0, 4}, BlobFilter{BlobShape::own, 4, 0}, BlobFilter{BlobShape::own, 3, 4},
          BlobFilter{BlobShape::own, 4, 6}, BlobFilter{BlobShape::own, 4, 4, 1}})
        refused(blob, unknown);
    refused({good.bytes.begin(), good.bytes.end() - 1}, good.filter);
    refused({good.bytes.begin(), good.bytes.begin() + 4}, good.filter);
    refused(blob, good.filter);
    auto fewer = good.bytes;  // as many bytes, but the last column's number stands among the rows: records name it still
    std::uint32_t counts[2];
    std::memcpy(counts, fewer.data(), sizeof counts);
    --counts[0], ++counts[1];
    std::memcpy(fewer.data(), counts, sizeof counts);
    refused(fewer, good.filter);
    EXPECT_FALSE(undo_filter(good.bytes, good.filter, std::span(undone).first(undone.size() - 1)));
}

}  // namespace
}  // namespace strata
