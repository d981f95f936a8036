// What the host expects of a frame's lighting against what its tiles need (docs/algorithms/lighting.md 3.6).
#include <algorithm>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/material.h"
#include "passes/lighting/spectra.h"
#include "passes/scene/scene_facts.h"
#include "passes/shaders/light_features.shared.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/spectra/spectra.h"
#include "tests/support/session.h"

namespace strata {
namespace {

std::uint32_t spectrum_of(const Frame& frame) { return SceneFacts(frame).spectrum(); }
std::vector<std::uint32_t> possible_spectra_of(const Frame& frame, std::uint32_t features) {
    return SceneFacts(frame).possible_spectra(features);
}

TEST(FrameSpectrum, T3_4_HoldsEveryBitThatATileOfAnyLightingScenarioNeeds) {
    const Technique& technique = *must(technique_of_spectra({}));
    std::uint32_t seen = 0;
    for (const std::string_view scenario : info(technique.stage).scenarios) {
        Session& session = session_of_scenarios();
        const Request request = on_scenario(scenario);
        const auto gathered = must(gather_spectra(session, technique, request, std::array{request.variant.frame}));
        const std::uint32_t expected = spectrum_of(must(session.frame(request.variant.frame)));
        std::uint32_t needed = 0;
        for (const FrameSpectra& frame : gathered.frames)
            for (const auto& [spectrum, tiles] : frame.tiles) needed |= spectrum;
        EXPECT_EQ(needed & ~expected, 0u) << scenario << " needs " << lighting::braced_names(needed & ~expected);
        seen |= needed;
    }
    EXPECT_NE(seen, 0u);
}

TEST(FrameSpectrum, KnowsEverySpectrumThatATileOfAnyLightingScenarioHas) {
    const Technique& technique = *must(technique_of_spectra({}));
    for (const std::string_view scenario : info(technique.stage).scenarios) {
        Session& session = session_of_scenarios();
        const Request request = on_scenario(scenario);
        const auto gathered = must(gather_spectra(session, technique, request, std::array{request.variant.frame}));
        const auto possible = possible_spectra_of(must(session.frame(request.variant.frame)), every_light_feature);
        for (const FrameSpectra& frame : gathered.frames)
            for (const auto& [spectrum, tiles] : frame.tiles)
                EXPECT_EQ(std::ranges::count(possible, spectrum), 1) << scenario << ' ' << lighting::spectrum_text(spectrum);
    }
}

Frame lights_room() { return scenario_frames("lights_room").front(); }

/// The room with one light of the type, a meter to the right and so far ahead of the eye.
std::uint32_t spectrum_of_a_light(LightType type, double ahead, float range) {
    Frame frame = lights_room();
    frame.sun.irradiance = glm::vec3(0);
    const glm::dmat3 to_world = glm::transpose(frame.view.to_view);
    frame.lights = {{.type = type, .position = frame.view.origin + to_world * glm::dvec3(1, 0, ahead), .range = range}};
    return spectrum_of(frame);
}

TEST(FrameSpectrum, LacksWhatLightsNeedWhoseRangeDoesNotMeetTheView) {
    EXPECT_EQ(spectrum_of_a_light(LightType::tube, 20, 5), std::uint32_t(feature_tube));
    EXPECT_EQ(spectrum_of_a_light(LightType::tube, -10, 5), 0u) << "behind the eye";
    EXPECT_EQ(spectrum_of_a_light(LightType::tube, -10, 12), std::uint32_t(feature_tube)) << "its range comes to the front";
    EXPECT_EQ(spectrum_of_a_light(LightType::round_spot, 20, 5), std::uint32_t(feature_round_spot));
    EXPECT_EQ(spectrum_of_a_light(LightType::directional, -10, 1), 0u) << "needs nothing but itself";
}

TEST(FrameSpectrum, HasTheModelsOfOpaqueSurfacesInView) {
    Frame frame = lights_room();
    frame.sun.irradiance = glm::vec3(0);
    frame.lights.clear();
    EXPECT_EQ(spectrum_of(frame), 0u);
    for (Material& material : frame.materials) material.lighting_model = LightingModel::cloth;
    EXPECT_EQ(spectrum_of(frame), std::uint32_t(feature_cloth));
    for (Material& material : frame.materials) material.alpha_mode = AlphaMode::blend;
    EXPECT_EQ(spectrum_of(frame), 0u) << "transparent surfaces are lit elsewhere";
    for (Material& material : frame.materials) material = {.lighting_model = LightingModel::hair};
    for (Draw& draw : frame.draws) draw.to_world[3] += glm::dvec4(0, 1e4, 0, 0);
    EXPECT_EQ(spectrum_of(frame), 0u) << "ten kilometers up";
}

TEST(FrameSpectrum, HasTapVisibilityWhereBlockersMayStopAVolumesLight) {
    Frame frame = lights_room();
    frame.sun.irradiance = glm::vec3(0);
    frame.lights.clear();
    frame.light_volumes = {{.occlusion = VolumeOcclusion::axial}};
    EXPECT_EQ(spectrum_of(frame), 0u);
    frame.blockers.emplace_back();
    EXPECT_EQ(spectrum_of(frame), std::uint32_t(feature_gi_tap_visibility));
    frame.light_volumes[0].occlusion = VolumeOcclusion::fuzzy_geometry;
    EXPECT_EQ(spectrum_of(frame), std::uint32_t(feature_gi_tap_visibility)) << "a setting may choose axial occlusion";
    frame.light_volumes.clear();
    EXPECT_EQ(spectrum_of(frame), 0u);
}

TEST(FrameSpectrum, OfATileHasShadowsOnlyWithTheLightThatCastsThem) {
    Frame frame = lights_room();
    frame.sun.irradiance = glm::vec3(0);
    for (Material& material : frame.materials) material.lighting_model = LightingModel::lambert;
    Light lamp{.type = LightType::omni, .position = frame.view.origin, .range = 5};
    Light tube{.type = LightType::tube, .position = frame.view.origin, .range = 5};
    lamp.shadow.casts = true;
    frame.lights = {lamp, tube};
    const std::uint32_t omni = feature_omni, shadows = feature_shadows, tubes = feature_tube;
    auto spectra = possible_spectra_of(frame, every_light_feature);
    std::ranges::sort(spectra);
    std::vector<std::uint32_t> expected = {0, omni, omni | shadows, tubes, tubes | omni, tubes | omni | shadows};
    std::ranges::sort(expected);
    EXPECT_EQ(spectra, expected);
    EXPECT_EQ(possible_spectra_of(frame, omni | tubes).size(), 4u) << "without shadows";
}

}  // namespace
}  // namespace strata
