// transparency/voxel on a device: integers add up to the same whoever adds them first, and however an overflow is met.
#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "passes/registry.h"
#include "tests/support/session.h"

namespace strata {
namespace {

const std::string voxel = "transparency/voxel";

Run run_of(Session& session, std::vector<std::string> sets, std::vector<std::string> outputs = {"color"}) {
    session.forget_memo();
    return must(session.run({.uses = {voxel}, .sets = std::move(sets), .outputs = std::move(outputs)}));
}

std::vector<std::byte> color_of(Session& session, std::vector<std::string> sets) {
    return run_of(session, std::move(sets)).images.at("color").texels;
}

std::uint64_t count_of(const Run& run, std::string_view counter) {
    return std::ranges::find(run.counters, counter, &CounterRecord::name)->value;
}

/// The channel at a pixel of an rgba32f image.
float shown_at(const Run& run, const std::string& view, std::size_t pixel) {
    float value = 0;
    std::memcpy(&value, run.images.at(voxel + ":" + view).texels.data() + 16 * pixel, sizeof value);
    return value;
}

TEST(VoxelVolume, IsTheSameInEveryRun) {
    const auto session = scenario_session("particle_storm", 4);
    for (const char* splat : {"splat=words", "splat=saturating", "splat=overflow_minimum"}) {
        const auto first = color_of(*session, {splat, "resolution=eighth"});
        for (int i = 0; i < 3; ++i) EXPECT_EQ(color_of(*session, {splat, "resolution=eighth"}), first) << splat;
    }
}

TEST(VoxelVolume, IntegratesAnOverflowAsIfItSaturated) {
    const auto session = scenario_session("three_cards", 1);  // of alpha .99 in one slice: 636 of 255
    const auto packed = run_of(*session, {});
    EXPECT_GT(count_of(packed, "overflowed"), 0u);
    EXPECT_EQ(count_of(packed, "border atomics"), 0u);
    EXPECT_EQ(color_of(*session, {"splat=saturating"}), packed.images.at("color").texels);
    EXPECT_EQ(color_of(*session, {"splat=words"}), packed.images.at("color").texels);
    EXPECT_LT(count_of(run_of(*session, {"splat=wrapping"}), "saturated"), count_of(packed, "saturated"));
}

/// Numbers that fit nothing, and settings that meet only here.
TEST(VoxelVolume, IsWhatTheModelSaysInCombinations) {
    const Technique& technique = *must(find_technique(voxel));
    const std::vector<std::string> combinations[] = {
        {"slices=37", "bits=16", "splatting=point", "sampling=bicubic", "shift=0.5"},
        {"slices=1023", "resolution=sixteenth", "sampling=bicubic"},
        {"slices=99", "resolution=half", "rounding=stochastic", "curve=thickness", "near_thickness=0.3"},
        {"slices=33", "splat=saturating", "bits=16", "farthest=9"},
        {"splat=words", "bits=32", "channels=mono", "resolution=quarter", "sampling=point", "splatting=point"},
    };
    for (const std::vector<std::string>& sets : combinations) {
        Request request = on_scenario("glass_and_smoke", 4);
        request.uses = {voxel};
        request.sets = sets;
        const Accuracy accuracy = must(session_of_scenarios().judge(request, technique.stage));
        EXPECT_LE(accuracy.model_rmse, technique.tolerance.rmse) << sets.front();
        EXPECT_LE(accuracy.model_worst, technique.tolerance.worst) << sets.front();
    }
}

TEST(VoxelVolume, ShowsWhereItOverflowsAndFromWhereNothingIsSeen) {
    const auto session = scenario_session("three_cards", 1);
    const View view = must(session->frame(0)).view;
    const auto run = run_of(*session, {}, {voxel + ":zero depth", voxel + ":overflow", voxel + ":thickness"});
    std::size_t overflowed = 0;
    for (std::size_t pixel = 0; pixel < std::size_t{view.width} * view.height; ++pixel) {
        if (shown_at(run, "overflow", pixel) == 128) continue;
        ++overflowed;
        // The cards are in one slice, and two and a half slices on nothing is left in a filtered read.
        const float thickness = shown_at(run, "thickness", pixel);
        EXPECT_GT(shown_at(run, "zero depth", pixel), 2 * thickness);
        EXPECT_GT(thickness, .1f);
    }
    EXPECT_EQ(overflowed, count_of(run_of(*session, {}), "overflowed"));
}

}  // namespace
}  // namespace strata
