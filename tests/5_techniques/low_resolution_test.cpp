// Draws of two resolutions in one frame. Techniques whose sums have no order draw at half resolution what is recorded so and
// merge it; the others draw everything at full resolution.
#include <array>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/particles.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "tests/support/agreement.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::string_view additive = "transparency/weighted_additive";

/// Smoke at half resolution among panes at full; odd sizes share no pixel grid.
Frame low_resolution_smoke(std::uint32_t width, std::uint32_t height, std::uint32_t samples) {
    Frame frame = scenario_frames("glass_and_smoke", samples).front();
    frame.view.width = width, frame.view.height = height;
    for (Emitter& emitter : frame.emitters) emitter.resolution = Resolution::low;
    return frame;
}

struct Merging {
    std::string_view technique, counter;  ///< of fragments that are shaded into what is merged
    std::vector<std::string> settings;
};

const std::vector<Merging>& merging() {
    static const std::vector<Merging> techniques = {
        {"transparency/weighted", "fragments", {"form=normalized", "form=average", "form=sum"}},
        {additive, "fragments", {"normalization=published", "normalization=corrected"}},
        {"transparency/adaptive", "drawn", {"nodes=8"}},
        {"transparency/exact_function", "drawn", {"accumulation=half", "accumulation=packed", "pool=0.01"}},
        {"transparency/moments", "drawn", {"resolution=full", "resolution=quarter", "storage=normalized"}},
        {"transparency/wavelet", "drawn", {"bounds=frame", "bounds=pixel", "resolution=half"}},
        {"transparency/voxel", "drawn", {"resolution=full", "resolution=quarter"}},
    };
    return techniques;
}

Session& smoke() {
    static const auto session =
        session_of({low_resolution_smoke(96, 54, 1), low_resolution_smoke(53, 31, 1), low_resolution_smoke(64, 36, 4)});
    return *session;
}

class LowResolution : public testing::TestWithParam<std::size_t> {};

TEST_P(LowResolution, IsMergedAsTheModelSays) {
    const Merging& merged = merging()[GetParam()];
    const Technique& technique = *must(find_technique(merged.technique));
    for (std::size_t frame = 0; frame < smoke().frame_count(); ++frame)
        for (const std::string& set : merged.settings) {
            const Request request{.variant = {.frame = frame}, .choices = chosen({std::string(merged.technique)}, {set})};
            const Accuracy accuracy = must(smoke().judge(request, technique.stage, Against::model));
            expect_within_tolerance(accuracy, technique, request);
            EXPECT_LT(double(accuracy.undecided), .4 * double(accuracy.compared + accuracy.undecided));
        }
}

TEST_P(LowResolution, ShadesAQuarterOfTheFragments) {
    const Merging& merged = merging()[GetParam()];
    const auto fragments = [&](Resolution resolution) {
        Frame frame = low_resolution_smoke(96, 54, 1);
        for (Emitter& emitter : frame.emitters) emitter.resolution = resolution;
        std::erase_if(frame.draws, [&](const Draw& draw) { return is_transparent(frame.materials[draw.material].alpha_mode); });
        const auto session = session_of({frame});
        return double(counted(must(session->run({.choices = chosen({std::string(merged.technique)})})), merged.counter));
    };
    EXPECT_NEAR(fragments(Resolution::low) / fragments(Resolution::full), .25, .03);
}

std::string merging_technique_name(const testing::TestParamInfo<std::size_t>& info) {
    const std::string_view name = merging()[info.param].technique;
    return std::string(name.substr(name.find('/') + 1));
}

// Of techniques that sum, of those that build a function, and of those that keep a volume.
INSTANTIATE_TEST_SUITE_P(Kinds, LowResolution, testing::Values(0u, 2u, 6u), merging_technique_name);
INSTANTIATE_TEST_SUITE_P(Exhaustive, LowResolution, testing::Range(std::size_t{0}, merging().size()), merging_technique_name);

/// Smoke is soft: what half resolution costs a technique that is exact otherwise is small, and seen.
TEST(ExhaustiveLowResolutionError, OfAnExactFunctionIsThatOfFilteringSmoke) {
    const auto error = [&](Resolution resolution) {
        Frame frame = low_resolution_smoke(160, 90, 1);
        for (Emitter& emitter : frame.emitters) emitter.resolution = resolution;
        const auto session = session_of({frame});
        return must(session->judge({.choices = chosen({"transparency/exact_function"}, {"accumulation=single"})},
                                   Stage::transparency, Against::truth))
            .technique_errors.front()
            .value;
    };
    EXPECT_LT(error(Resolution::full), 1e-5);
    EXPECT_GT(error(Resolution::low), 1e-3);
    EXPECT_LT(error(Resolution::low), 5e-2);
}

TEST(WrittenTiles, AreAllThatBilinearEdgesReach) {
    const auto color_of = [](std::size_t frame, std::vector<std::string> sets) {
        return must(smoke().run({.variant = {.frame = frame},
                                 .choices = chosen({std::string(additive)}, std::move(sets)),
                                 .outputs = {"color"}}))
            .images.at("color");
    };
    for (std::size_t frame = 0; frame < smoke().frame_count(); ++frame)
        EXPECT_EQ(color_of(frame, {}).texels, color_of(frame, {"tiles=all"}).texels) << frame;
}

}  // namespace
}  // namespace strata
