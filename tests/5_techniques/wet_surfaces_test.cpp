// Wet surfaces on the device: every layout of the G-buffer keeps them, dry ones stay to the bit, and stages before see no water.
#include <algorithm>
#include <cstring>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "replay/images/image_io.h"
#include "tests/support/agreement.h"
#include "tests/support/print.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::string_view scenario = "roof_in_rain";

Frame shelter(std::uint32_t samples = 1) { return scenario_frames(scenario, samples).front(); }

/// The same under a clear sky.
Frame dry_shelter(std::uint32_t samples = 1) {
    Frame frame = shelter(samples);
    frame.rain.intensity = frame.rain.wetness = 0;
    return frame;
}

std::size_t rain_steps(const Run& run) {
    return std::size_t(std::ranges::count_if(run.steps, [](const StepRecord& step) { return step.scope.stage == Stage::rain; }));
}

std::vector<double> numbers(const std::vector<Metric>& metrics) {
    std::vector<double> values;
    for (const Metric& metric : metrics) values.push_back(metric.value);
    return values;
}

// --- layouts ----------------------------------------------------------------------------------------------------------------

/// How far the normals of a layout may be from those that were stored, relative as errors of models are: its worst angle of
/// docs/algorithms/deferred.md 2.5 over the root mean square of a component.
double worst_normal(std::string_view layout) {
    static const std::map<std::string_view, double> degrees = {{"gbuffer/packed", 2.12},
                                                               {"gbuffer/z_first", 1.89},
                                                               {"gbuffer/oct_half", .059},
                                                               {"gbuffer/compact", .237},
                                                               {"gbuffer/wide", .0229}};
    const auto found = degrees.find(layout);
    return 2 * (found == degrees.end() ? .004 : found->second) * .01745 / .577;
}

/// A layout, its samples, and where attributes are shaded.
struct LayoutCase {
    std::string technique;
    std::uint32_t samples = 1;
    std::string attributes = "center";
};

void PrintTo(const LayoutCase& c, std::ostream* out) { *out << c.technique << ' ' << c.attributes << " at " << c.samples; }

std::vector<LayoutCase> all_layouts() {
    std::vector<LayoutCase> cases;
    for (const Technique* technique : techniques_of(Stage::gbuffer))
        for (const LayoutCase& kind : {LayoutCase{"", 1}, {"", 4}, {"", 4, "sample"}})
            cases.push_back({std::string(technique->name), kind.samples, kind.attributes});
    return cases;
}

/// Every layout once.
std::vector<LayoutCase> some_layouts() {
    std::vector<LayoutCase> cases;
    const std::vector<LayoutCase> all = all_layouts();
    for (std::size_t i = 0; i < all.size(); i += 3) cases.push_back(all[i + i / 3 % 3]);
    return cases;
}

class WetLayout : public testing::TestWithParam<LayoutCase> {};

TEST_P(WetLayout, KeepsTheWetSurfaceAsItKeepsADryOne) {
    const LayoutCase& c = GetParam();
    Session& session = session_of_scenarios();
    const Technique& wetness = *techniques_of(Stage::rain).front();
    Request request = on_scenario(scenario, c.samples);
    request.choices = chosen({c.technique}, {"attributes=" + c.attributes, "ripple_filter=off"});
    const Accuracy accuracy = must(session.judge(request, Stage::rain, Against::model));
    ASSERT_EQ(accuracy.incomparable, "");
    RecordProperty("errors", fmt::format("rmse {:.3g} worst {:.3g}", accuracy.model_rmse, accuracy.model_worst));
    const WorstTexel& w = accuracy.worst;
    EXPECT_LE(accuracy.model_worst, std::max(wetness.tolerance.worst, worst_normal(c.technique)))
        << w.image << " at " << w.x << ", " << w.y << " layer " << w.layer;
    EXPECT_LE(accuracy.model_rmse, std::max(wetness.tolerance.rmse, .1 * worst_normal(c.technique)));
    EXPECT_LT(double(accuracy.undecided), .1 * double(accuracy.compared + accuracy.undecided));
}

std::string case_name(const testing::TestParamInfo<LayoutCase>& tested) {
    const LayoutCase& c = tested.param;
    return as_identifier(fmt::format("{}_{}_at_{}", c.technique, c.attributes, c.samples));
}

INSTANTIATE_TEST_SUITE_P(Some, WetLayout, testing::ValuesIn(some_layouts()), case_name);
INSTANTIATE_TEST_SUITE_P(Exhaustive, WetLayout, testing::ValuesIn(all_layouts()), case_name);

// --- what stays dry ---------------------------------------------------------------------------------------------------------

TEST(WetSurfaces, CostNothingInDryWeatherAndNothingWhereTheyAreForced) {
    const auto session = session_of({dry_shelter()});
    Request request{.outputs = {"gbuffer0", "gbuffer1", "display"}};
    const auto dry = must(session->run(request));
    EXPECT_EQ(rain_steps(dry), 0u);
    request.variant.force = {Feature::rain};
    const auto forced = must(session->run(request));
    EXPECT_EQ(rain_steps(forced), 0u);
    for (const auto& [name, image] : dry.images) EXPECT_EQ(hash_of(image), hash_of(forced.images.at(name))) << name;
}

/// Texels of the first image that differ, by their bits.
std::vector<bool> differing(const HostImage& a, const HostImage& b) {
    const std::size_t texels = a.shape.extent.width * a.shape.extent.height * a.shape.layers, bytes = a.texels.size() / texels;
    std::vector<bool> differ(texels);
    for (std::size_t i = 0; i < texels; ++i)
        differ[i] = std::memcmp(a.texels.data() + i * bytes, b.texels.data() + i * bytes, bytes) != 0;
    return differ;
}

TEST(WetSurfaces, LeaveCeilingsAndShelteredOnesAsTheyAreToTheBit) {  // T-RN-3, T-RN-6
    const auto session = session_of({shelter(4), dry_shelter(4)});
    Request request{.outputs = {"gbuffer0", "gbuffer1", "surface_normal", "surface_color"}};
    const auto wet = must(session->run(request));
    request.variant.frame = 1;
    const auto dry = must(session->run(request));
    const ReferenceImage wet_color = in_double(wet.images.at("surface_color")),
                         dry_color = in_double(dry.images.at("surface_color"));
    const ReferenceImage normal = in_double(dry.images.at("surface_normal"));
    const std::vector<bool> words0 = differing(wet.images.at("gbuffer0"), dry.images.at("gbuffer0"));
    const std::vector<bool> words1 = differing(wet.images.at("gbuffer1"), dry.images.at("gbuffer1"));
    const glm::dmat3 to_world = glm::transpose(shelter().view.to_view);
    std::size_t wet_texels = 0, ceilings = 0, same = 0;
    for (std::size_t i = 0; i < normal.texels.size(); ++i) {
        if (normal.texels[i].w <= 0) continue;
        const bool is_ceiling = (to_world * glm::dvec3(normal.texels[i])).y < -.6;
        ceilings += is_ceiling;
        EXPECT_FALSE(is_ceiling && (words0[i] || words1[i]));
        const bool is_colored = wet_color.texels[i] != dry_color.texels[i];
        wet_texels += is_colored;
        same += !words0[i] && !words1[i];
    }
    EXPECT_GT(ceilings, 50u);
    EXPECT_GT(wet_texels, 1000u);
    EXPECT_GT(same, 500u) << "the floor, the bench and the wall below the roof";
}

TEST(WetSurfaces, WithoutWavesKeepTheirNormals) {  // T-RN-4
    const auto session = session_of({shelter(), dry_shelter()});
    Request request{.choices = chosen({}, {"ripple_height=0", "flow_height=0", "puddles=0"}), .outputs = {"surface_normal"}};
    const ReferenceImage wet = in_double(must(session->run(request)).images.at("surface_normal"));
    request = {.outputs = {"surface_normal"}};
    request.variant.frame = 1;
    const ReferenceImage dry = in_double(must(session->run(request)).images.at("surface_normal"));
    for (std::size_t i = 0; i < dry.texels.size(); ++i)
        ASSERT_LT(glm::length(wet.texels[i] - dry.texels[i]), 2 * .004 * .01745) << i << ": what the layout rounds normals to";
}

// --- other stages -----------------------------------------------------------------------------------------------------------

TEST(WetSurfaces, AreNotWhatEarlierStagesAreJudgedBy) {
    const auto session = session_of({shelter(4), dry_shelter(4)});
    for (const Stage stage : {Stage::gbuffer, Stage::edges}) {
        Request request;
        const Accuracy wet = must(session->judge(request, stage, Against::model_and_truth));
        request.variant.frame = 1;
        const Accuracy dry = must(session->judge(request, stage, Against::model_and_truth));
        EXPECT_EQ(numbers(wet.technique_errors), numbers(dry.technique_errors)) << name(stage);
        EXPECT_EQ(wet.model_worst, dry.model_worst) << name(stage);
        EXPECT_FALSE(wet.technique_errors.empty());
    }
}

TEST(WetSurfaces, AreWhatLaterStagesShade) {
    const auto session = session_of({shelter(), dry_shelter()});
    Request request{.outputs = {"light"}};
    const ReferenceImage wet = in_double(must(session->run(request)).images.at("light"));
    const Accuracy accuracy = must(session->judge(request, Stage::lighting, Against::model));
    EXPECT_LE(accuracy.model_worst, techniques_of(Stage::lighting).front()->tolerance.worst)
        << "the model starts from wet surfaces";
    request.variant.frame = 1;
    const ReferenceImage dry = in_double(must(session->run(request)).images.at("light"));
    std::size_t differ = 0;
    for (std::size_t i = 0; i < wet.texels.size(); ++i) differ += wet.texels[i] != dry.texels[i];
    EXPECT_GT(differ, 500u);
}

TEST(WetSurfaces, OfATruthThatTakesItsPlaceReachThePicture) {
    const auto session = session_of({shelter()});
    Request request{.outputs = {"surface_color", "display"}};
    const ImageSet truth = must(session->truth(request, Stage::rain));
    const auto given = must(session->run_from(request, Stage::rain, truth));
    const ReferenceImage color = in_double(given.images.at("surface_color"));
    for (std::size_t i = 0; i < color.texels.size(); ++i)
        ASSERT_LT(glm::length(color.texels[i] - truth.at("surface_color").texels[i]), 1e-6);
    EXPECT_NE(hash_of(given.images.at("display")), hash_of(must(session->run(request)).images.at("display")));
    // The true dry surfaces are floats: they get wet as floats.
    const ImageSet surfaces = must(session->truth(request, Stage::gbuffer));
    const auto wet = must(session->run_from(request, Stage::gbuffer, surfaces));
    EXPECT_GT(rain_steps(wet), 0u);
    EXPECT_NE(hash_of(wet.images.at("surface_color")), hash_of(given.images.at("surface_color")));
}

TEST(WetSurfaces, DoNotKnowParticles) {
    Frame smoky = shelter();
    Emitter smoke{.name = "smoke"};
    for (int i = 0; i < 20; ++i) smoke.particles.push_back({.center = {.1 * i - 1, 3.2, .5}, .size = .6f, .alpha = .5f});
    smoky.emitters.push_back(smoke);
    const auto session = session_of({shelter(), smoky});
    Request request{.outputs = {"surface_color", "surface_normal"}};
    const auto clear = must(session->run(request));
    request.variant.frame = 1;
    const auto behind = must(session->run(request));
    for (const auto& [name, image] : clear.images) EXPECT_EQ(hash_of(image), hash_of(behind.images.at(name))) << name;
}

// --- wind -------------------------------------------------------------------------------------------------------------------

std::size_t steps_named(const Run& run, std::string_view name) {
    return std::size_t(std::ranges::count(run.steps, name, &StepRecord::name));
}

void expect_model_in_wind(const Request& request) {
    const Technique& wetness = *techniques_of(Stage::rain).front();
    const Accuracy accuracy = must(session_of_scenarios().judge(request, Stage::rain, Against::model));
    expect_within_tolerance(accuracy, wetness, request);
    EXPECT_LT(double(accuracy.undecided), .2 * double(accuracy.compared + accuracy.undecided));
}

TEST(WetSurfaces, InATurningWindAreWhatTheModelSays) {
    Request request = on_scenario(scenario);
    request.choices = chosen({}, {"rain_directions=3", "rain_spread=20", "ripple_filter=off"});
    expect_model_in_wind(request);
}

TEST(ExhaustiveWetSurfaces, InATurningWindAreWhatTheModelSays) {
    for (const std::string_view name : {scenario, std::string_view("zone_at_dusk")})
        for (const char* directions : {"rain_directions=2", "rain_directions=5", "rain_directions=8"}) {
            Request request = on_scenario(name, 4);
            request.choices = chosen({}, {directions, "ripple_filter=off"});
            expect_model_in_wind(request);
        }
}

TEST(WetSurfaces, InATurningWindCostAMapPerDirection) {
    const auto session = session_of({shelter()});
    Request request{.outputs = {"gbuffer0"}};
    const auto still = must(session->run(request));
    request.choices = chosen({}, {"rain_directions=5"});
    const auto windy = must(session->run(request));
    EXPECT_EQ(steps_named(still, "rain/wetness/record.comp"), 0u);
    EXPECT_EQ(steps_named(windy, "rain/wetness/record.comp"), 5u);
    EXPECT_GT(steps_named(still, "rain/wetness/cast"), 0u);
    EXPECT_EQ(steps_named(windy, "rain/wetness/cast"), 5 * steps_named(still, "rain/wetness/cast"));
    // Of 1024 x 1024 texels of 4 bytes.
    EXPECT_GE(windy.stage_bytes.at("rain"), still.stage_bytes.at("rain") + 4 * (4u << 20));
}

// --- far and late -----------------------------------------------------------------------------------------------------------

/// H18, H19: cells and phases are told in whole ones and a rest, so floats see small numbers wherever and whenever it rains.
TEST(WetSurfaces, AgreeWithTheModelTenKilometersAwayAfterAMonth) {
    Frame far = shelter();
    const glm::dvec3 away(10'003.3, 21.7, -7'777.7);
    far.view.origin += away;
    for (Draw& draw : far.draws) {
        draw.to_world[3] += glm::dvec4(away, 0);
        draw.previous_to_world[3] += glm::dvec4(away, 0);
    }
    far.time += 30 * 86'400.;
    const auto session = session_of({far});
    const Technique& wetness = *techniques_of(Stage::rain).front();
    const Request request{.choices = chosen({}, {"ripple_filter=off"})};
    expect_within_tolerance(must(session->judge(request, Stage::rain, Against::model)), wetness, request);
}

}  // namespace
}  // namespace strata
