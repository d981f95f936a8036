// An application records while it renders: resources outlive frames, threads submit together, memory stays within the budget.
#include <array>
#include <random>
#include <thread>

#include <gmock/gmock.h>

#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "tests/1_capture/frame_fields.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

/// A recorder with the triangle's mesh and material.
Recorder triangles(const std::filesystem::path& path, const RecorderOptions& options = {}) {
    auto recorder = Recorder::create(path, {}, options);
    EXPECT_TRUE(recorder);
    recorder->add_mesh(triangle_frame().meshes[0]);
    recorder->add_material(triangle_frame().materials[0]);
    return *std::move(recorder);
}

void begin(Recorder& recorder, std::uint64_t index = 0) { recorder.begin_frame(triangle_frame().view, 0, index, 0); }

Texture picture(std::uint32_t width, std::uint32_t height, std::uint64_t seed) {
    Texture texture{.name = "screen", .width = width, .height = height, .texels = {}};
    std::mt19937_64 random(seed);
    texture.texels.resize(std::size_t{4} * width * height);
    for (std::byte& texel : texture.texels) texel = static_cast<std::byte>(random());
    return texture;
}

TEST(Streaming, ResourcesBelongToAllLaterFramesAndSubmissionsToOne) {
    const TemporaryFile file;
    Recorder recorder = triangles(file.path());
    for (int i = 0; i < 3; ++i) {
        begin(recorder);
        if (i != 1) recorder.draw({.name = "it"});
        ASSERT_TRUE(recorder.end_frame());
    }
    ASSERT_TRUE(recorder.finish());
    const auto capture = Capture::open(file.path());
    EXPECT_EQ(capture->frame(2)->meshes[0].positions, triangle_frame().meshes[0].positions);
    EXPECT_EQ(capture->frame(0)->draws.size(), 1u);
    EXPECT_EQ(capture->frame(1)->draws.size(), 0u);
    EXPECT_EQ(bits_of(*capture->frame(2)), bits_of(*capture->frame(0)));
}

TEST(Streaming, AnUpdateBelongsToTheFrameThatIsOpenAndAllLaterOnes) {
    const TemporaryFile file;
    Recorder recorder = triangles(file.path());
    EXPECT_EQ(recorder.add_texture(picture(2, 2, 0)), 0u);
    for (std::uint64_t i = 0; i < 4; ++i) {
        begin(recorder);
        if (i == 2) recorder.update_texture(0, picture(4, 2, 1));
        if (i == 3) recorder.update_material(0, {.name = "red", .base_color = {1, 0, 0, 1}});
        ASSERT_TRUE(recorder.end_frame());
    }
    ASSERT_TRUE(recorder.finish());
    const auto capture = Capture::open(file.path());
    EXPECT_EQ(capture->frame(1)->textures[0].texels, picture(2, 2, 0).texels);
    EXPECT_EQ(capture->frame(2)->textures[0].texels, picture(4, 2, 1).texels);
    EXPECT_EQ(capture->frame(2)->materials[0].name, "plain");
    EXPECT_EQ(capture->frame(3)->materials[0].name, "red");
    EXPECT_EQ(capture->summary().blobs, 2u + 2u) << "positions, indices, two pictures";
}

TEST(Streaming, ThreadsSubmitTogetherAndABatchStaysTogether) {
    const TemporaryFile file;
    Recorder recorder = triangles(file.path());
    begin(recorder);
    constexpr int threads = 4, batches = 50, batch = 20;
    std::vector<std::thread> running;
    for (int t = 0; t < threads; ++t)
        running.emplace_back([&recorder, t] {
            for (int b = 0; b < batches; ++b) {
                std::vector<Draw> draws(batch, Draw{.sort_priority = t * batches + b});
                recorder.draws(draws);
                recorder.light({.name = "lamp"});
                recorder.update_material(0, {.name = "plain"});
            }
        });
    for (std::thread& thread : running) thread.join();
    ASSERT_TRUE(recorder.end_frame() && recorder.finish());
    const Frame frame = *Capture::open(file.path())->frame(0);
    ASSERT_EQ(frame.draws.size(), std::size_t{threads * batches * batch});
    EXPECT_EQ(frame.lights.size(), std::size_t{threads * batches});
    std::array<int, threads> last;
    last.fill(-1);
    for (std::size_t i = 0; i < frame.draws.size(); ++i) {
        const int id = frame.draws[i].sort_priority;
        EXPECT_EQ(id, frame.draws[i - i % batch].sort_priority) << "a batch was torn apart";
        EXPECT_GE(id, last[static_cast<std::size_t>(id / batches)]) << "a thread's own order was changed";
        last[static_cast<std::size_t>(id / batches)] = id;
    }
}

TEST(Streaming, ABadResourceKeepsFramesOutUntilItIsReplaced) {
    const TemporaryFile file;
    Recorder recorder = triangles(file.path());
    Mesh torn = triangle_frame().meshes[0];
    torn.indices = {0, 1, 7};
    const auto one_frame = [&] {
        begin(recorder);
        const auto ended = recorder.end_frame();  // the thread may be done already
        return ended ? recorder.flush() : ended;
    };
    recorder.update_mesh(0, torn);
    EXPECT_THAT(one_frame(), FailsWith("frame.vertex_range", Field("index", 2), Field("vertex", 7), Field("vertices", 3),
                                       Field("subject", "mesh"), Field("name", "triangle"), Field("frame", 0)));
    recorder.update_mesh(0, triangle_frame().meshes[0]);
    EXPECT_TRUE(one_frame());
    EXPECT_TRUE(recorder.finish());
    EXPECT_EQ(Capture::open(file.path())->frame_count(), 1u);
}

TEST(Streaming, WhatCanNeverFitTheBudgetIsAnErrorWithBothNumbers) {
    const TemporaryFile file;
    Recorder recorder = triangles(file.path(), {.budget_bytes = 100'000});
    begin(recorder);
    recorder.draws(std::vector<Draw>(400));
    const auto frame = recorder.end_frame();
    ASSERT_FALSE(frame);
    EXPECT_THAT(frame, FailsWith("record.budget", Field("resource", "frame 0 with 400 draws"),
                                 Field("bytes", testing::MatchesRegex("[0-9]{6}")), Field("budget", 100000)));
    begin(recorder);
    EXPECT_TRUE(recorder.end_frame() && recorder.flush()) << "a frame that was too large is left out, later ones follow";
    recorder.add_texture(picture(256, 256, 0));
    EXPECT_THAT(recorder.finish(),
                FailsWith("record.budget", Field("resource", "texture 0 'screen'"), Field("bytes", testing::StartsWith("262"))));
    EXPECT_EQ(recorder.frames_written(), 1u);
}

TEST(Streaming, CallsWaitWhileTheBudgetIsUsedUp) {
    const TemporaryFile file;
    Recorder recorder = triangles(file.path(), {.budget_bytes = 1'000'000});
    recorder.add_texture(picture(256, 256, 0));
    for (std::uint64_t i = 0; i < 40; ++i) {
        begin(recorder);
        recorder.update_texture(0, picture(256, 256, i));
        ASSERT_TRUE(recorder.end_frame());
    }
    ASSERT_TRUE(recorder.finish());
    EXPECT_LE(recorder.load().most_held_bytes, 1'000'000u);
    EXPECT_GT(recorder.load().most_held_bytes, 500'000u);
    EXPECT_EQ(recorder.load().held_bytes, 0u);
    EXPECT_EQ(Capture::open(file.path())->frame_count(), 40u);
}

TEST(Streaming, FlushMakesEveryFrameReadable) {
    const TemporaryFile file;
    Recorder recorder = triangles(file.path());
    for (std::uint64_t i = 1; i <= 5; ++i) {
        begin(recorder, i);
        ASSERT_TRUE(recorder.end_frame() && recorder.flush());
        EXPECT_EQ(recorder.frames_written(), i);
        const auto capture = Capture::open(file.path(), Partial::allowed);
        ASSERT_EQ(capture->frame_count(), i);
        EXPECT_EQ(capture->frame(i - 1)->index, i);
    }
}

TEST(Streaming, CallsOutOfOrderAreNamedByTheNextThatReturns) {
    const TemporaryFile file, another("another");
    Recorder outside = triangles(file.path());
    outside.draw({});
    begin(outside);
    EXPECT_THAT(outside.end_frame(), FailsWith("record.outside_frame", Field("call", "draw")));
    Recorder unknown = triangles(another.path());
    unknown.update_texture(3, {});
    EXPECT_THAT(unknown.flush(),
                FailsWith("record.index_out_of_range", Field("call", "update_texture"), Field("index", 3), Field("count", 0)));
}

}  // namespace
}  // namespace strata
