// Draws come and go; those that stay are told by what changed.
#include "capture_format/codec/draw_runs.h"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>

#include "capture_format/codec/encode_frame.h"
#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "tests/1_capture/sample_frames.h"

namespace strata {
namespace {

using Bytes = std::vector<std::byte>;

Draw flying(double lane, int frame) {
    Draw draw{.mobility = Mobility::moving};
    draw.to_world[3] = {lane, .01 * lane * frame, 5 + .02 * frame, 1};
    draw.previous_to_world[3] = {lane, .01 * lane * (frame - 1), 5 + .02 * (frame - 1), 1};
    return draw;
}

Bytes flatbuffer(std::vector<Draw> draws) {
    Frame frame = triangle_frame();
    frame.draws = std::move(draws);
    BlobCollector blobs;
    return encode_frame(frame, blobs);
}

std::size_t words_in(std::span<const FrameChain::Run> runs) {
    std::size_t sum = 0;
    for (const FrameChain::Run& run : runs) sum += run.words;
    return sum;
}

TEST(DrawRuns, TheSameDrawsAreOneRun) {
    const Bytes before = flatbuffer({flying(1, 0), flying(2, 0)}), now = flatbuffer({flying(1, 1), flying(2, 1)});
    const auto runs = draw_runs(before, now);
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_EQ(runs[0].from, 0u);
    EXPECT_EQ(runs[0].words, now.size() / 8);
}

TEST(DrawRuns, ADrawThatIsGoneLeavesTheOthersWhatTheyWere) {
    const Bytes before = flatbuffer({flying(1, 0), flying(2, 0), flying(3, 0), flying(4, 0)});
    const Bytes now = flatbuffer({flying(1, 1), flying(3, 1), flying(4, 1)});
    const auto runs = draw_runs(before, now);
    EXPECT_EQ(runs.size(), 2u) << "what lies before the gap and what lies behind it";
    EXPECT_EQ(words_in(runs), now.size() / 8);
}

TEST(DrawRuns, FramesWithoutDrawsAreLaidEndToEnd) {
    const Bytes before = flatbuffer({}), now = flatbuffer({flying(1, 1)});
    EXPECT_EQ(words_in(draw_runs(before, now)), now.size() / 8);
    EXPECT_EQ(words_in(draw_runs(now, before)), before.size() / 8);
    EXPECT_EQ(draw_runs(now, before).back().from + draw_runs(now, before).back().words, now.size() / 8);
}

/// Bytes of nine frames that each draw another nine tenths of 1000 things, the draws matched or laid end to end.
std::size_t bytes_of_crowd(bool matched) {
    std::mt19937_64 random(1);
    FrameChain writing, reading;
    std::size_t bytes = 0;
    for (int frame = 0; frame < 12; ++frame) {
        std::vector<Draw> draws;
        for (int lane = 0; lane < 1000; ++lane)
            if (random() % 10 != 0) draws.push_back(flying(lane / 7., frame));
        const Bytes raw = flatbuffer(draws);
        const auto runs = matched && frame > 0 ? draw_runs(writing.newest(), raw) : std::vector<FrameChain::Run>();
        const Bytes payload = writing.pack(raw, echo_of(raw), runs);
        const auto unpacked = reading.unpack(payload, raw.size());
        EXPECT_TRUE(unpacked && std::ranges::equal(*unpacked, raw)) << frame;
        if (frame > 2) bytes += payload.size();
    }
    return bytes;
}

TEST(DrawRuns, ACrowdOfWhichATenthIsHiddenCostsLessThanHalfOfOneThatIsLaidEndToEnd) {
    const std::size_t matched = bytes_of_crowd(true), unmatched = bytes_of_crowd(false);
    EXPECT_LT(2 * matched, unmatched);
    EXPECT_GT(matched, 9 * 50 * 3 * 8u) << "some fifty draws a frame are new";
}

}  // namespace
}  // namespace strata
