// How often shaders run, counted by a part of the frame: as a whole run counts it.
#include "replay/session/step_counts.h"

#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "replay/session/device_session.h"
#include "tests/support/session.h"

namespace strata {
namespace {

Request on(const std::string& scenario, const std::string& technique) {
    Request request = on_scenario(scenario);
    request.choices = chosen({technique});
    return request;
}

TEST(StepCounts, OfIndirectDispatchesAreWhatAWholeRunCounts) {
    Session& session = session_of_scenarios();
    const Request request = on("agents_hq", "lighting/tiled");
    const StepCounts counts = must(count_steps(session, request));
    const RunOptions counted{.invocations = Invocations::counted};
    const auto whole = must(static_cast<DeviceSession&>(session).time_alone(request, counted));
    const Plan plan = must(session.plan(request)).plan;
    ASSERT_EQ(counts.invocations.size(), plan.steps.size());
    std::size_t compared = 0;
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const auto* compute = std::get_if<ComputeWork>(&plan.steps[i].step.work);
        if (!compute || !compute->arguments) continue;
        EXPECT_EQ(counts.invocations[i], whole.step_costs[i].invocations) << plan.steps[i].step.name;
        compared += *counts.invocations[i] > 0;
    }
    EXPECT_GE(compared, 4u);
}

TEST(StepCounts, OfATechniqueThatDrawsOnceAreItsOwn) {
    Session& session = session_of_scenarios();
    const Request request = on("three_panes", "transparency/weighted");
    const StepCounts counts = must(count_steps(session, request));
    const auto fragments = [](const std::vector<CounterRecord>& counters) {
        const auto found = std::ranges::find(counters, fragments_counter, &CounterRecord::name);
        return found == counters.end() ? 0 : found->value;
    };
    EXPECT_GT(fragments(counts.counters), 100u);
    EXPECT_EQ(fragments(counts.counters), fragments(must(session.run(request)).counters));
}

/// Fragments of every step that draws what is transparent, by the rasterizer in double.
std::vector<std::uint64_t> rasterized(Session& session, const Request& request) {
    std::vector<std::uint64_t> all;
    for (const auto& count : must(count_steps(session, request)).rasterized)
        if (count) all.push_back(*count);
    return all;
}

// The counter of sorted lists is an atomic of the device. Panes cover every fragment of theirs, smoke does not: the corners of
// its particles run shaders, too, and are counted by none.
TEST(StepCounts, OfEveryDrawOfWhatIsTransparentAreTheRasterizersWhereADeviceCannotCount) {
    Session& session = session_of_scenarios();
    if (!session.device().software) GTEST_SKIP() << "this device counts fragments";
    const auto counter = [&](const std::string& scenario) {
        return counted(must(session.run(on(scenario, "transparency/sorted_lists"))), "fragments");
    };
    const std::pair<const char*, std::size_t> steps[] = {{"alpha_blend", 1}, {"weighted", 1}, {"sorted_lists", 2},
                                                         {"stochastic", 2},  {"moments", 2},  {"exact_function", 3}};
    const std::uint64_t of_panes = counter("three_panes"), of_smoke = counter("smoke_grenade");
    for (const auto& [technique, count] : steps) {
        const std::string name = std::string("transparency/") + technique;
        EXPECT_EQ(rasterized(session, on("three_panes", name)), std::vector(count, of_panes)) << name;
        const auto smoke = rasterized(session, on("smoke_grenade", name));
        EXPECT_EQ(smoke.size(), count) << name;
        for (const std::uint64_t fragments : smoke) {
            EXPECT_GT(fragments, of_smoke + of_smoke / 20) << name;
            EXPECT_LT(fragments, 2 * of_smoke) << name;
        }
    }
    EXPECT_TRUE(rasterized(session, on("three_panes", "transparency/depth_peeling")).empty()) << "tested against its own depth";
}

TEST(StepCounts, LeaveOutFragmentsBehindOpaqueSurfaces) {
    // Each pane in turn is opaque.
    const Frame panes = scenario_frames("three_panes").front();
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < panes.materials.size(); ++i) {
        if (panes.materials[i].alpha_mode != AlphaMode::blend) continue;
        frames.push_back(panes);
        frames.back().materials[i].alpha_mode = AlphaMode::opaque;
    }
    ASSERT_EQ(frames.size(), 3u);
    const auto session = session_of(frames);
    if (!session->device().software) GTEST_SKIP() << "this device counts fragments";
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Request request{.variant = {.frame = i}, .choices = chosen({"transparency/sorted_lists"})};
        const std::uint64_t fragments = counted(must(session->run(request)), "fragments");
        EXPECT_EQ(rasterized(*session, request), std::vector(2, fragments)) << i;
    }
}

// The device culls backs where every transparent surface is single-sided. Beside smoke, shaders run there and discard.
TEST(StepCounts, CountBacksWhereShadersDiscardThem) {
    Frame turned = scenario_frames("three_panes").front();
    for (Material& material : turned.materials) material.double_sided = false;
    for (std::size_t i = 0; i < turned.draws.size(); ++i) {
        if (turned.materials[turned.draws[i].material].alpha_mode != AlphaMode::blend) continue;
        std::vector<std::uint32_t>& indices = turned.meshes[turned.draws[i].mesh].indices;
        for (std::size_t k = 0; k + 2 < indices.size(); k += 3) std::swap(indices[k + 1], indices[k + 2]);
        break;  // one pane seen from behind is enough
    }
    Frame beside_smoke = turned;
    Emitter smoke{.name = "smoke"};
    smoke.particles.push_back({.center = {0, 0, -1e4}, .size = 1e-3f, .color = glm::vec3(0), .alpha = .5f});
    beside_smoke.emitters.push_back(std::move(smoke));
    const auto session = session_of({turned, beside_smoke});
    if (!session->device().software) GTEST_SKIP() << "this device counts fragments";
    std::uint64_t of_frame[2] = {};
    for (std::size_t i = 0; i < 2; ++i) {
        const Request request{.variant = {.frame = i}, .choices = chosen({"transparency/sorted_lists"})};
        const std::uint64_t stored = counted(must(session->run(request)), "fragments");
        of_frame[i] = rasterized(*session, request).front();
        if (i == 0) {
            EXPECT_EQ(of_frame[0], stored) << "none are culled by shaders";
        } else {
            EXPECT_GT(of_frame[1], stored + 100) << "and all by shaders";
        }
    }
    EXPECT_GT(of_frame[1], of_frame[0] + 100);
}

TEST(StepCounts, AreKnownWithoutTheShadersThatTheyAreOf) {
    // On a device of its own, which has no pipelines of other tests.
    const auto session = must(Session::open(scenario_frames("agents_hq"), {.validation = true}));
    Request request{.choices = chosen({"lighting/tiled"})};
    must(count_steps(*session, request));
    request.until = "lighting/tiled/shade.comp";
    const auto run = must(session->run(request));
    const auto shades = std::ranges::count(run.steps, request.until, &StepRecord::name);
    EXPECT_GE(shades, 4);
    EXPECT_GE(run.pipelines_created, static_cast<std::size_t>(shades)) << "they were not there before";
}

}  // namespace
}  // namespace strata
