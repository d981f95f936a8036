// What fails says so, keeps nothing half made, and the next run gives what it always gave.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/graph/graph.h"
#include "replay/images/image_io.h"
#include "replay/session/memo.h"
#include "tests/support/device.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"
#include "tests/support/shader_folder.h"

namespace strata {
namespace {

constexpr std::uint64_t mib = 1 << 20;

TEST(Failure, WhileAFrameIsRecordedLeavesTheSessionAsItWas) {
    const auto session = scenario_session("glass_and_smoke");
    const std::string before = display_hash(*session);
    const auto planned = must(session->plan({}));
    std::size_t failed = 0;
    for (const ImageRecord& image : planned.plan.images) {
        // At the end of the frame a later image has taken the memory of some.
        const auto peeked = session->peek({}, planned.plan.steps.size() - 1, image.name);
        if (peeked || peeked.error().fault != Fault::device_failed) continue;
        EXPECT_THAT(peeked, FailsWith("device.image_holds_nothing"));
        if (++failed == 3) break;
    }
    ASSERT_GT(failed, 0u);
    EXPECT_EQ(display_hash(*session), before);
    session->forget_memo();
    EXPECT_EQ(display_hash(*session), before);
}

TEST(Failure, OfAShaderThatNeedsWhatTheDeviceLacksEndsWithTheShader) {
    const ShaderFolder folder;
    const auto session = scenario_session("three_panes");
    const std::string before = display_hash(*session);
    const std::string source = "passes/combine/hi_lo/film.comp";
    folder.change(source, "sum / float(samples)", "vec3(dvec3(sum) / double(samples))");  // no baseline has shaderFloat64
    must(session->reload_shaders(folder.path()));
    const auto run = session->run({});
    ASSERT_THAT(run, FailsWith("device.validation_message"));
    EXPECT_EQ(run.error().fault, Fault::device_failed);
    folder.restore(source);
    must(session->reload_shaders(folder.path()));
    EXPECT_EQ(display_hash(*session), before);
    session->forget_memo();
    EXPECT_EQ(display_hash(*session), before);
}

/// A cleared image of so many bytes, kept.
std::pair<Plan, Image> cleared(std::uint32_t edge) {
    Graph graph;
    Image image = graph.create("cleared", {.extent = {edge, edge}, .format = Format::rgba32f});
    graph.clear(image, {{.25, .5, .75, 1}});
    graph.keep(image);
    return {must(compile(graph, ShaderLibrary::built_in())), image};
}

TEST(Failure, ForLackOfMemoryGivesEverythingBack) {
    const auto device = must(Device::open({.validation = true, .memory_budget = 8 * mib}));
    const auto executor = Executor::create(*device);
    const auto [large, large_image] = cleared(1024);  // 16 MiB
    const auto [small, small_image] = cleared(64);
    const std::uint64_t before = executor->memory().in_use;
    EXPECT_THROW(executor->run(large, {}), DeviceFailure);
    EXPECT_EQ(executor->memory().in_use, before);
    const Execution execution = executor->run(small, {});
    EXPECT_EQ(texel(execution.images.at(small_image.id), 63, 63), glm::dvec4(.25, .5, .75, 1));
    EXPECT_TRUE(device->take_messages().empty());
}

TEST(Failure, OfAKeptImageIsNothingTheMemoHolds) {
    const auto device = must(Device::open({.validation = true, .memory_budget = 8 * mib}));
    const auto executor = Executor::create(*device);
    Memo memo(*executor, 1024 * mib);
    const auto [large, large_image] = cleared(1024);
    const std::uint64_t before = executor->memory().in_use;
    EXPECT_THROW(memo.reserve(1, std::span(&large.images[large_image.id], 1)), DeviceFailure);
    memo.drop_unfilled();
    EXPECT_EQ(memo.held(), 0u);
    EXPECT_EQ(executor->memory().in_use, before);
    EXPECT_EQ(memo.find(1, {}), nullptr);
    const auto [small, small_image] = cleared(64);
    EXPECT_NE(memo.reserve(1, std::span(&small.images[small_image.id], 1)), nullptr);
}

}  // namespace
}  // namespace strata
