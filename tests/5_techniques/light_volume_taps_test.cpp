// What surfaces read of light propagation volumes on a device: taps ask the blockers of their macro-cell and get the bits of
// asking all.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "passes/registry.h"
#include "replay/images/host_image.h"
#include "tests/support/random_numbers.h"
#include "tests/support/session.h"

namespace strata {
namespace {

const std::string lpv = "indirect/lpv";

Run indirect_light(Session& session, const std::vector<std::string>& sets, std::size_t frame = 0) {
    Request request{.variant = {.frame = frame}, .choices = chosen({lpv}, sets)};
    request.outputs = {"indirect", "surface_normal"};
    return must(session.run(request));
}

std::uint64_t count_of(const Run& run, std::string_view name) {
    for (const CounterRecord& counter : run.counters)
        if (counter.technique == lpv && counter.name == name) return counter.value;
    throw std::runtime_error("no counter " + std::string(name));
}

/// The two rooms with the door open, and blockers of any size and direction in them, every second with a portal.
Frame with_random_blockers(std::size_t count, unsigned seed) {
    Frame frame = scenario_frames("two_rooms", 1, 2)[1];
    Numbers numbers(seed);
    while (frame.blockers.size() < count) {
        Blocker blocker;
        blocker.center = glm::dvec3(0, 1.4, -2) + glm::dvec3(numbers.box(1)) * glm::dvec3(4.4, 1.8, 2.4);
        blocker.u = numbers.direction(), blocker.v = numbers.across(blocker.u);
        blocker.half_u = numbers.from(.05f, 1), blocker.half_v = numbers.from(.05f, 1);
        if (frame.blockers.size() % 2 == 0)
            frame.portals.push_back({.center = blocker.center,
                                     .u = blocker.u,
                                     .v = blocker.v,
                                     .half_u = .5f * blocker.half_u,
                                     .half_v = .5f * blocker.half_v,
                                     .blocker = static_cast<std::uint32_t>(frame.blockers.size())});
        frame.blockers.push_back(blocker);
    }
    // A frame's portals come in any order.
    std::ranges::reverse(frame.portals);
    for (Light& light : frame.lights) std::ranges::fill(light.portals, static_cast<std::uint32_t>(frame.portals.size() - 1));
    return frame;
}

TEST(LightVolumeTaps, AskTheBlockersOfTheirMacroCellAndGetTheBitsOfAskingAll) {
    const std::vector<Frame> rooms = scenario_frames("two_rooms", 1, 2);
    const auto session = must(Session::open(
        {rooms[0], rooms[1], with_random_blockers(32, 1), with_random_blockers(33, 2), with_random_blockers(100, 3)},
        {.validation = true}));
    for (const std::size_t frame : {0, 1, 2, 3, 4}) {
        const Run near = indirect_light(*session, {}, frame), all = indirect_light(*session, {"macro_cells=off"}, frame);
        EXPECT_TRUE(near.images.at("indirect").texels == all.images.at("indirect").texels) << frame;
        EXPECT_EQ(count_of(near, "hidden taps"), count_of(all, "hidden taps")) << frame;
        EXPECT_GT(count_of(near, "hidden taps"), 500u) << frame;
        EXPECT_GT(count_of(near, "samples near blockers"), 0u) << frame;
        EXPECT_LT(count_of(near, "blocker tests"), (frame < 2 ? .9 : .5) * double(count_of(all, "blocker tests"))) << frame;
        EXPECT_EQ(count_of(all, "samples near blockers"), count_of(all, "samples")) << frame;
    }
}

TEST(LightVolumeTaps, AskNothingWhereNoBlockerIsNear) {
    Frame frame = scenario_frames("two_rooms", 1, 2)[1];
    for (Blocker& blocker : frame.blockers) blocker.center.y += 100;
    for (Portal& portal : frame.portals) portal.center.y += 100;
    const auto session = must(Session::open({frame}, {.validation = true}));
    const Run far = indirect_light(*session, {}), all = indirect_light(*session, {"macro_cells=off"});
    EXPECT_TRUE(far.images.at("indirect").texels == all.images.at("indirect").texels);
    EXPECT_EQ(count_of(far, "samples near blockers"), 0u);
    EXPECT_EQ(count_of(far, "blocker tests"), 0u);
    EXPECT_EQ(count_of(far, "hidden taps"), 0u);
}

/// A blocker's portals are found without asking all of the frame: drivers end loops of more than 65,535 turns.
TEST(LightVolumeTaps, SeeThroughAThousandWindows) {
    Frame frame = with_random_blockers(27, 4);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const auto blocker = static_cast<std::uint32_t>(7 + i % 20);
        const Blocker& wall = frame.blockers[blocker];
        const float across = -.95f + .19f * float(i / 20 % 10), up = -.9f + .4f * float(i / 200);
        frame.portals.push_back({.center = wall.center + glm::dvec3(across * wall.half_u * wall.u + up * wall.half_v * wall.v),
                                 .u = wall.u,
                                 .v = wall.v,
                                 .half_u = .04f * wall.half_u,
                                 .half_v = .1f * wall.half_v,
                                 .blocker = blocker});
    }
    const auto session = must(Session::open({frame}, {.validation = true}));
    const Accuracy accuracy = must(session->judge({.choices = chosen({lpv})}, Stage::indirect, Against::model));
    const Technique& technique = *must(find_technique(lpv));
    EXPECT_LT(accuracy.model_rmse, technique.tolerance.rmse);
    EXPECT_LT(accuracy.model_worst, technique.tolerance.worst);
}

ReferenceImage view_of(Session& session, const std::string& view, const std::vector<std::string>& sets = {},
                       std::size_t frame = 0) {
    Request request{.variant = {.frame = frame}, .choices = chosen({lpv}, sets)};
    request.outputs = {lpv + ":" + view};
    return in_double(must(session.run(request)).images.at(request.outputs[0]));
}

double largest(const ReferenceImage& picture) {
    double most = 0;
    for (const glm::dvec4& texel : picture.texels) most = std::max(most, texel.x);
    return most;
}

TEST(LightVolumeTaps, AreSeenByTheBlockersNearTheirMacroCell) {
    const auto session = must(Session::open({scenario_frames("two_rooms", 1, 2)[1]}, {.validation = true}));
    const ReferenceImage near = view_of(*session, "macro-cells"), all = view_of(*session, "macro-cells", {"macro_cells=off"});
    EXPECT_EQ(largest(all), 7);
    EXPECT_LT(largest(near), 7) << "walls on both ends are never near the same cells";
    EXPECT_GE(largest(near), 3) << "in a corner";
    EXPECT_EQ(largest(view_of(*session, "macro-cells", {"taps=all"})), 0);
}

/// A grid around the left half of the left room, before the frame's own.
TEST(LightVolumeTaps, AreOfTheGridThatTheVolumeViewNames) {
    Frame frame = scenario_frames("two_rooms", 1, 2)[1];
    LightVolume left = frame.light_volumes[0];
    left.center.x = -4, left.half_extent = {2, 2, 2.8f}, left.cells = {5, 5, 7};
    frame.light_volumes.insert(frame.light_volumes.begin(), left);
    const auto session = must(Session::open({frame}, {.validation = true}));
    const ReferenceImage picture = view_of(*session, "volume");
    std::size_t first = 0, second = 0, blended = 0;
    for (const glm::dvec4& texel : picture.texels) {
        if (texel.x == 0) continue;
        ASSERT_GE(texel.x, 1);
        ASSERT_LT(texel.x, 2.5);
        (std::round(texel.x) == 1 ? first : second) += 1;
        blended += texel.x != std::round(texel.x);
    }
    EXPECT_GT(first, 100u);
    EXPECT_GT(second, 500u);
    EXPECT_GT(blended, 50u);
}

}  // namespace
}  // namespace strata
