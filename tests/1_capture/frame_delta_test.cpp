// A frame told by what changed: every bit comes back, what goes straight on or turns costs next to nothing, lies are refused.
#include "capture_format/codec/frame_delta.h"

#include <bit>
#include <cfenv>
#include <cmath>
#include <functional>
#include <random>

#include <gmock/gmock.h>

#include "tests/support/errors.h"

namespace strata {
namespace {

using Bytes = std::vector<std::byte>;
using Words = std::vector<std::uint64_t>;

std::span<const std::byte> raw(const Words& words) { return std::as_bytes(std::span(words)); }

/// Packs frames one after the other and expects every one back; the payloads' sizes.
std::vector<std::size_t> sizes_of(std::span<const Words> frames, std::int64_t echo = 0) {
    FrameChain writing, reading;
    std::vector<std::size_t> sizes;
    for (const Words& words : frames) {
        const Bytes payload = writing.pack(raw(words), echo);
        const auto unpacked = reading.unpack(payload, raw(words).size());
        EXPECT_TRUE(unpacked && std::ranges::equal(*unpacked, raw(words))) << "frame " << sizes.size();
        sizes.push_back(payload.size());
    }
    return sizes;
}

/// Frames of 1000 numbers, each given by its index and the frame's.
std::vector<Words> frames_of(std::size_t count, const std::function<double(std::size_t, std::size_t)>& value) {
    std::vector<Words> frames(count, Words(1000));
    for (std::size_t t = 0; t < count; ++t)
        for (std::size_t i = 0; i < frames[t].size(); ++i) frames[t][i] = std::bit_cast<std::uint64_t>(value(i, t));
    return frames;
}

/// What arithmetic would lose: NaN payloads, -0, infinities, subnormals, the largest numbers, anything.
std::uint64_t odd_word(std::mt19937_64& random) {
    const std::uint64_t telling[] = {0x7ff0'0000'0000'0001,
                                     0x8000'0000'0000'0000,
                                     0x7ff0'0000'0000'0000,
                                     1,
                                     0x7fef'ffff'ffff'ffff,
                                     0x3ff0'0000'0000'0000,
                                     random(),
                                     0};
    return telling[random() % std::size(telling)];
}

TEST(FrameDelta, EveryBitComesBackWhateverTheWords) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        std::mt19937_64 random(seed);
        std::vector<Words> frames(8, Words(random() % 300));
        for (Words& frame : frames)
            for (std::uint64_t& word : frame) word = odd_word(random);
        sizes_of(frames, static_cast<std::int64_t>(random() % 64) - 32);
    }
}

TEST(FrameDelta, WhatStaysTheSameCostsNothing) {
    const auto sizes = sizes_of(frames_of(4, [](std::size_t i, std::size_t) { return std::sqrt(i); }));
    EXPECT_GT(sizes[0], 5000u);
    EXPECT_LT(sizes[2], 100u);
}

TEST(FrameDelta, WhatMovesStraightOnCostsNextToNothing) {
    std::vector<double> position(1000);
    const auto sizes = sizes_of(frames_of(8, [&](std::size_t i, std::size_t t) {
        return position[i] = t == 0 ? std::sqrt(i) : position[i] + std::sin(static_cast<double>(i)) / 64;
    }));
    EXPECT_GT(sizes[1], 4000u) << "the speed is news";
    EXPECT_LT(sizes[6], 500u);
}

TEST(FrameDelta, WhatTurnsCostsAFewBitsPerNumber) {
    const auto sizes = sizes_of(frames_of(
        8, [](std::size_t i, std::size_t t) { return 3 + std::cos(static_cast<double>(i) + .05 * static_cast<double>(t)); }));
    EXPECT_LT(sizes[6], 2000u);
    EXPECT_GT(sizes[3], 2 * sizes[6]) << "a turn shows after four frames";
}

TEST(FrameDelta, AnEchoCostsNothing) {
    std::mt19937_64 random(1);
    std::vector<Words> frames(5, Words(1000));
    for (std::size_t t = 0; t < frames.size(); ++t) {
        for (std::size_t i = 0; i < 500; ++i) frames[t][i] = random();
        for (std::size_t i = 500; i < 1000 && t > 0; ++i) frames[t][i] = frames[t - 1][i - 500];
    }
    EXPECT_NEAR(static_cast<double>(sizes_of(frames, 500)[4]), 4000, 100) << "only the 500 that are random";
}

TEST(FrameDelta, OneFrameInSixtyFourNeedsNoOther) {
    FrameChain chain;
    const Words words(10, 7);
    for (std::uint32_t i = 0; i < 2 * frames_per_key; ++i)
        EXPECT_EQ(*FrameChain::reach(chain.pack(raw(words), 0)), i % frames_per_key);
}

TEST(FrameDelta, AFrameOfAnotherSizeStillCostsOnlyWhatIsNew) {
    auto frames = frames_of(4, [](std::size_t i, std::size_t) { return std::sqrt(i); });
    frames[2].insert(frames[2].begin(), 10, 42);  // flatbuffers grow at their beginning
    const auto sizes = sizes_of(frames);
    EXPECT_LT(sizes[2], 200u);
    EXPECT_LT(sizes[3], 200u);
}

TEST(FrameDelta, RoundingOfTheApplicationChangesNothing) {
    const auto frames = frames_of(8, [](std::size_t i, std::size_t t) { return std::sqrt(static_cast<double>(i * t)); });
    FrameChain writing, reading;
    for (const Words& words : frames) {
        std::fesetround(FE_UPWARD);
        const Bytes payload = writing.pack(raw(words), 0);
        EXPECT_EQ(std::fegetround(), FE_UPWARD) << "it is the application's";
        std::fesetround(FE_TONEAREST);
        EXPECT_TRUE(reading.unpack(payload, raw(words).size()));
    }
}

/// What comes of unpacking the third of three equal frames after `change` was made to its payload.
Result<void> unpacked_after(const std::function<void(Bytes&, std::uint64_t&)>& change) {
    const Words words(10, 7);
    FrameChain writing, reading;
    std::uint64_t bytes = raw(words).size();
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(reading.unpack(writing.pack(raw(words), 0), bytes));
    Bytes payload = writing.pack(raw(words), 0);
    change(payload, bytes);
    const auto unpacked = reading.unpack(payload, bytes);
    EXPECT_TRUE(unpacked || reading.newest().empty()) << "nothing is built on what failed";
    return unpacked ? Result<void>() : unpacked.error();
}

TEST(FrameDelta, LiesAreRefusedBeforeAnythingIsAllocated) {
    const auto put = [](std::size_t at, std::uint32_t value) {
        return [=](Bytes& payload, std::uint64_t&) { std::memcpy(payload.data() + at, &value, sizeof(value)); };
    };
    EXPECT_TRUE(unpacked_after([](Bytes&, std::uint64_t&) {}));
    EXPECT_THAT(unpacked_after([](Bytes& payload, std::uint64_t&) { payload.resize(23); }), FailsWith("capture.frame.too_short"));
    EXPECT_THAT(unpacked_after(put(0, 64)), FailsWith("capture.frame.too_many_before", Field("reach", 64), Field("most", 63)));
    EXPECT_THAT(unpacked_after(put(0, 1)), FailsWith("capture.frame.order", Field("reach", 1), Field("frames", 2)));
    EXPECT_THAT(unpacked_after(put(4, 1u << 30)), FailsWith("capture.frame.runs_cut", Field("runs", 1073741824)));
    EXPECT_THAT(unpacked_after(put(16, 1)), FailsWith("capture.frame.hash"));
    EXPECT_THAT(unpacked_after(put(24, 5)),
                FailsWith("capture.frame.run_range", Field("from", 5), Field("words", 10), Field("frame_words", 10)));
    EXPECT_THAT(unpacked_after(put(28, 4)), FailsWith("capture.frame.run_sum", Field("words", 4), Field("frame_words", 10)));
    EXPECT_THAT(unpacked_after([](Bytes&, std::uint64_t& bytes) { bytes = 1ull << 40; }),
                FailsWith("capture.frame.claimed_size", Field("bytes", 1099511627776)));
    EXPECT_THAT(unpacked_after([](Bytes&, std::uint64_t& bytes) { bytes += 8; }),
                FailsWith("capture.section.zstd_size", Field("bytes", 88)));
}

}  // namespace
}  // namespace strata
