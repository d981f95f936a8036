// The queue between an application's threads and the recorder's: nothing is lost, and the budget holds.
#include "capture_format/recording_queue.h"

#include <array>
#include <thread>

#include <gtest/gtest.h>

namespace strata {
namespace {

EncodedThumbnail thumbnail_of(std::uint64_t texel_bytes) { return {.bytes = {}, .texel_bytes = texel_bytes}; }

TEST(RecordingQueue, HandsOverWhatThreadsPushInTheOrderOfEach) {
    constexpr std::uint64_t pushes = 200, bytes = 10, budget = 100;
    RecordingQueue queue(budget);
    std::array<std::uint64_t, 3> sums = {}, latest = {};
    std::thread writer([&] {
        while (const auto item = queue.pop()) {
            const std::uint64_t number = std::get<EncodedThumbnail>(*item).texel_bytes;
            const std::size_t of = number % sums.size();
            EXPECT_GT(number, latest[of]);
            latest[of] = number;
            ++sums[of];
        }
    });
    std::array<std::thread, 3> applications;
    for (std::uint64_t of = 0; of < applications.size(); ++of) {
        applications[of] = std::thread([&, of] {
            for (std::uint64_t i = 1; i <= pushes; ++i) {
                EXPECT_TRUE(queue.push(thumbnail_of(3 * i + of), bytes, "a thumbnail"));
                EXPECT_LE(queue.load().held_bytes, budget);
            }
        });
    }
    for (std::thread& application : applications) application.join();
    queue.drain();
    EXPECT_GT(queue.load().most_held_bytes, budget / 2) << "the writer was woken for nothing";
    queue.close();
    writer.join();
    for (const std::uint64_t sum : sums) EXPECT_EQ(sum, pushes);
}

TEST(RecordingQueue, FramesGoRoundWithTheRoomOfTheirLists) {
    RecordingQueue queue(100);
    auto frame = queue.empty_frame();
    frame->draws.reserve(50);
    const Draw* room = frame->draws.data();
    std::thread([&] { queue.give_back(std::move(frame)); }).join();
    frame = queue.empty_frame();
    EXPECT_TRUE(frame->draws.empty());
    EXPECT_EQ(frame->draws.data(), room);
}

}  // namespace
}  // namespace strata
