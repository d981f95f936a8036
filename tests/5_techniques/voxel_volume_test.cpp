// transparency/voxel on a device: integers add up to the same whoever adds them first, and however an overflow is met.
#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/view.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/session/choice_text.h"
#include "tests/5_techniques/voxel_name.h"
#include "tests/support/agreement.h"
#include "tests/support/session.h"

namespace strata {
namespace {

Run run_of(Session& session, std::vector<std::string> sets, std::vector<std::string> outputs = {"color"}) {
    session.forget_memo();
    return must(session.run({.choices = chosen({voxel}, std::move(sets)), .outputs = std::move(outputs)}));
}

std::vector<std::byte> color_of(Session& session, std::vector<std::string> sets) {
    return run_of(session, std::move(sets)).images.at("color").texels;
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
    const std::string even = "volume=dense", fixed = "range=fixed";
    const auto packed = run_of(*session, {even, fixed});
    EXPECT_GT(counted(packed, "overflowed"), 0u);
    EXPECT_EQ(counted(packed, "border atomics"), 0u);
    EXPECT_EQ(color_of(*session, {even, fixed, "splat=saturating"}), packed.images.at("color").texels);
    EXPECT_EQ(color_of(*session, {even, fixed, "splat=words"}), packed.images.at("color").texels);
    EXPECT_LT(counted(run_of(*session, {even, fixed, "splat=wrapping"}), "saturated"), counted(packed, "saturated"));
}

/// Numbers that fit nothing, and settings that meet only here.
TEST(ExhaustiveVoxelVolume, IsWhatTheModelSaysInCombinations) {
    const Technique& technique = *must(find_technique(voxel));
    const std::vector<std::string> combinations[] = {
        {"slices=37", "bits=16", "splatting=point", "sampling=bicubic", "shift=0.5"},
        {"slices=1023", "resolution=sixteenth", "sampling=bicubic"},
        {"slices=99", "resolution=half", "rounding=stochastic", "curve=thickness", "near_thickness=0.3"},
        {"slices=33", "splat=saturating", "bits=16", "range=fixed", "farthest=9"},
        {"splat=words", "bits=32", "channels=mono", "resolution=quarter", "sampling=point", "splatting=point"},
        {"volume=dense", "slices=100", "range=fixed", "resolution=half"},
        {"volume=adaptive", "slices=40", "splatting=point", "sampling=point", "curve=linear", "linear=2"},
        {"bits=10", "slices=50", "rounding=stochastic"},
        {"packing=rgb10"},
        {"packing=rgb10", "bits=16", "splat=saturating", "resolution=quarter", "slices=67"},
        {"packing=rgb10", "bits=10", "splat=wrapping", "sampling=bicubic", "rounding=stochastic"},
        {"packing=rgb10", "bits=32", "skipping=off", "volume=dense", "splatting=point", "sampling=point"},
    };
    for (const std::vector<std::string>& sets : combinations) {
        Request request = on_scenario("glass_and_smoke", 4);
        request.choices = chosen({voxel}, sets);
        const Accuracy accuracy = must(session_of_scenarios().judge(request, technique.stage, Against::model));
        expect_within_tolerance(accuracy, technique, request, "glass_and_smoke");
    }
}

TEST(VoxelVolume, IsWhatTheModelSaysOfInterfaces) {
    const Technique& technique = *must(find_technique(voxel));
    const std::vector<std::string> combinations[] = {
        {"splat=multiply"},
        {"splatting=point", "sampling=point", "slices=33"},
        {"sampling=bicubic", "resolution=quarter", "bits=16"},
        {"volume=dense", "range=fixed", "shift=1"},
        {"channels=rgb", "packing=rgb10", "slices=1024", "rounding=stochastic"},
        {"prepared=before_opaque", "splat=words", "bits=32"},
    };
    for (const std::vector<std::string>& sets : combinations) {
        Request request = on_scenario("interface_layers", 4);
        request.choices = chosen({voxel}, sets);
        const Accuracy accuracy = must(session_of_scenarios().judge(request, technique.stage, Against::model));
        expect_within_tolerance(accuracy, technique, request, "interface_layers");
    }
}

void expect_nothing_missed(std::string_view scenario, std::uint32_t samples, std::vector<std::string> sets) {
    Request request = on_scenario(scenario, samples);
    request.choices = chosen({voxel}, std::move(sets)), request.outputs = {"color"};
    set(request, "skipping=off");
    const auto all = must(session_of_scenarios().run(request)).images.at("color").texels;
    set(request, "skipping=on");
    EXPECT_EQ(must(session_of_scenarios().run(request)).images.at("color").texels, all)
        << scenario << " " << testing::PrintToString(set_texts(request.choices));
}

// V10 of docs/algorithms/transparency.md 6.17. What is not cleared holds whatever other images left there.
TEST(ExhaustiveVoxelVolume, LeavesOutOnlyWhatNobodyReads) {
    const std::vector<std::string> combinations[] = {
        {"resolution=quarter", "sampling=bicubic", "slices=70"},
        {"resolution=half", "volume=dense", "shift=2", "bits=16"},
        {"splatting=point", "sampling=point", "shift=-2", "slices=1024"},
        {"packing=rgb10", "channels=rgb", "resolution=half", "slices=77"},
    };
    std::size_t turn = 0;
    for (const std::string_view scenario : info(Stage::transparency).scenarios) {
        expect_nothing_missed(scenario, 4, {});
        expect_nothing_missed(scenario, 1, combinations[turn++ % std::size(combinations)]);
    }
}

TEST(ExhaustiveVoxelVolume, CoversEveryFragmentThatItIsAskedToHold) {
    for (const std::string_view scenario : info(Stage::transparency).scenarios)
        for (const char* splatting : {"splatting=linear", "splatting=point"}) {
            Request request = on_scenario(scenario, 4);
            request.choices = chosen({voxel}, {splatting, "thinnest=1e-5"});
            EXPECT_EQ(counted(must(session_of_scenarios().run(request)), "uncovered"), 0u) << scenario << splatting;
        }
}

// (v) of docs/algorithms/transparency.md 9.7: a curve that the number of slices does not bend.
TEST(ExhaustiveVoxelVolume, ThatIsAdaptiveIsADenseOneOfAllItsVirtualSlices) {
    std::size_t finer = 0;
    for (const std::string_view scenario : info(Stage::transparency).scenarios) {
        Request request = on_scenario(scenario);
        request.outputs = {"color"};
        request.choices = chosen({voxel}, {"curve=linear", "linear=3", "slices=64", "thinnest=0.005"});
        const strata::Run adaptive = must(session_of_scenarios().run(request));
        const std::uint64_t slices = counted(adaptive, "virtual slices");
        if (slices > 1024 || counted(adaptive, "slices used") == 0) continue;
        finer += slices > 64;
        request.choices = chosen({voxel}, {"curve=linear", "linear=3", "slices=" + std::to_string(slices), "volume=dense"});
        EXPECT_EQ(must(session_of_scenarios().run(request)).images.at("color").texels, adaptive.images.at("color").texels)
            << scenario << " in " << slices;
    }
    EXPECT_GE(finer, 5u);
}

const char* const colored_scenarios[] = {"glass_and_smoke", "red_and_green_glass"};

TEST(VoxelVolume, AddsThreeChannelsAtOnceWhereTheyShareAWord) {
    for (const char* scenario : colored_scenarios) {
        const auto session = scenario_session(scenario, 1);
        const std::vector<std::string> point = {"splatting=point", "sampling=point"};
        const auto planes = run_of(*session, point);
        const auto packed = run_of(*session, {point[0], point[1], "packing=rgb10"});
        EXPECT_GT(counted(packed, "atomics"), 0u) << scenario;
        EXPECT_EQ(counted(planes, "columns"), 3 * counted(packed, "columns")) << scenario;
        EXPECT_LE(2 * counted(packed, "atomics"), counted(planes, "atomics")) << scenario;
    }
}

TEST(VoxelVolume, IsThatOfThreePlanesWhereNothingOverflows) {
    for (const char* scenario : colored_scenarios) {
        const auto session = scenario_session(scenario, 4);
        for (const char* splat : {"splat=overflow_minimum", "splat=saturating"})
            EXPECT_EQ(color_of(*session, {splat, "packing=rgb10"}), color_of(*session, {splat})) << scenario << splat;
    }
}

TEST(VoxelVolume, ShowsWhereItOverflowsAndFromWhereNothingIsSeen) {
    const auto session = scenario_session("ash_storm", 1);
    const View view = must(session->frame(0)).view;
    const auto run = run_of(*session, {}, {voxel + ":saturation depth", voxel + ":overflow", voxel + ":thickness"});
    std::size_t overflowed = 0;
    for (std::size_t pixel = 0; pixel < std::size_t{view.width} * view.height; ++pixel) {
        if (shown_at(run, "overflow", pixel) == 0) continue;
        ++overflowed;
        EXPECT_GT(shown_at(run, "saturation depth", pixel), 0) << "a word that overflows is full";
        EXPECT_GT(shown_at(run, "thickness", pixel), 0);
    }
    EXPECT_EQ(overflowed, counted(run_of(*session, {}), "overflowed"));
    EXPECT_GT(overflowed, 0u);
}

}  // namespace
}  // namespace strata
