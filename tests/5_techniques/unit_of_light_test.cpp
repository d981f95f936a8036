// Light in any unit: a frame with k times the light and 1 / k of the exposure is the same picture, and every technique is as far
// off in it as before. The scaling here is the test's own, and truths in the recorded unit are checked by what they sum to.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/particles.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/report/picture_error.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// Everything that is radiance, intensity or irradiance in a frame, by the schema's comments.
Frame in_unit(Frame frame, float k) {
    frame.view.exposure /= k;
    frame.sun.irradiance *= k;
    frame.hemisphere.sky *= k;
    frame.hemisphere.ground *= k;
    frame.background *= k;
    frame.fog.color *= k;
    for (Light& light : frame.lights) light.intensity *= k;
    for (Material& material : frame.materials) {
        material.emissive *= k;
        if (material.lighting_model == LightingModel::unlit) material.base_color *= glm::vec4(k, k, k, 1);
    }
    for (Emitter& emitter : frame.emitters)
        for (Particle& particle : emitter.particles) {
            particle.color *= k;
            particle.emissive *= k;
        }
    return frame;
}

/// Small, with everything that shines.
Frame of_scenario(std::string_view name) {
    Frame frame = scenario_frames(name).front();
    while (frame.view.width > 64) {
        frame.view.width /= 2;
        frame.view.height /= 2;
    }
    return frame;
}

constexpr float units[] = {1e-6f, 1e-3f, 1e3f, 1e6f};

/// How far two figures are apart, relative to the larger; what both are below is rounding.
double apart(double a, double b, double least) {
    if (std::isnan(a) && std::isnan(b)) return 0;
    return std::abs(a - b) / std::max({std::abs(a), std::abs(b), least});
}

/// A scenario in the unit it is recorded in and in others, and how far a technique is off in each.
class ErrorsByUnit {
public:
    explicit ErrorsByUnit(std::string_view scenario) : scenario_(scenario) {
        const Frame recorded = of_scenario(scenario);
        std::vector<Frame> frames{recorded};
        for (const float k : units) frames.push_back(in_unit(recorded, k));
        session_ = session_of(frames);
    }

    Session& session() { return *session_; }

    /// Prints a row: the first figure in the recorded unit, and the largest change of any figure by unit.
    void expect_equal(std::string_view name) {
        const Accuracy first = judged(name, 0);
        const std::vector<Metric> recorded = figures(first);
        if (recorded.empty()) return fmt::print("{} {}: cannot do the frame\n", scenario_, name);
        std::string row = fmt::format("{} {}: {} {:.4g}", scenario_, name, recorded[0].name, recorded[0].value);
        for (std::size_t i = 0; i < std::size(units); ++i) {
            const Accuracy accuracy = judged(name, i + 1);
            const std::vector<Metric> got = figures(accuracy);
            ASSERT_EQ(got.size(), recorded.size()) << name;
            EXPECT_EQ(accuracy.touched_share, first.touched_share) << name << " at " << units[i] << " times the light";
            double most = 0;
            for (std::size_t m = 0; m < got.size(); ++m) most = std::max(most, change(got[m], recorded[m], units[i], name));
            row += fmt::format("; at {:g} times {:.1e}", units[i], most);
        }
        fmt::print("{}\n", row);
    }

private:
    Accuracy judged(std::string_view name, std::size_t frame) {
        const Request request{.variant = {.frame = frame}, .choices = chosen({std::string(name)})};
        return must(session_->judge(request, must(find_technique(name))->stage, Against::truth));
    }

    /// Over the picture, and over what the stage changes of it.
    static std::vector<Metric> figures(const Accuracy& accuracy) {
        std::vector<Metric> all = accuracy.technique_errors;
        all.insert(all.end(), accuracy.touched.begin(), accuracy.touched.end());
        return all;
    }

    /// Radiance is in the frame's unit.
    double change(const Metric& got, const Metric& wanted, float k, std::string_view name) const {
        const double value = got.value / (wanted.unit == "radiance" ? double(k) : 1);
        // 1e-3 of an error, and what float rounding of the scaled light itself makes of one: 2^-20.
        const double relative = apart(value, wanted.value, 0x1p-20 * 1e3);
        EXPECT_LE(relative, 1e-3) << scenario_ << " " << name << " at " << k << " times the light, " << got.name << ": " << value
                                  << ", was " << wanted.value;
        return relative;
    }

    std::string_view scenario_;
    std::unique_ptr<Session> session_;
};

constexpr std::string_view bright_scenarios[] = {"night_market", "courtyard", "hall_with_shafts", "zone_at_dusk", "roof_in_rain"};

/// Techniques of a stage, in a scenario.
class ExhaustiveUnitOfLight : public testing::TestWithParam<std::tuple<std::string_view, std::size_t>> {};

}  // namespace

TEST(UnitOfLight, LeavesTheErrorsOfTechniquesThatStoreLight) {
    ErrorsByUnit errors("glass_and_smoke");
    for (const char* name : {"transparency/weighted", "transparency/moments", "lighting/tiled"}) errors.expect_equal(name);
}

TEST_P(ExhaustiveUnitOfLight, LeavesEveryError) {
    const auto& [scenario, index] = GetParam();
    const StageInfo& stage = stages()[index];
    ErrorsByUnit errors(scenario);
    if (std::ranges::count(must(errors.session().plan({})).skipped, stage.stage, &SkippedStage::stage) != 0)
        GTEST_SKIP() << scenario << " needs no " << stage.name;
    for (const Technique& technique : techniques())
        if (technique.stage == stage.stage) errors.expect_equal(technique.name);
}

INSTANTIATE_TEST_SUITE_P(Stages, ExhaustiveUnitOfLight,
                         testing::Combine(testing::ValuesIn(bright_scenarios), testing::Range<std::size_t>(0, stages().size())));

// Alternatives of undecided texels are radiance, too. Powers of two scale without rounding.
TEST(UnitOfLight, LeavesPictureErrorsAndScalesWhatElseATruthMayBe) {
    const Frame recorded = of_scenario("glass_and_smoke");
    constexpr float powers[] = {1, 64, 1.f / 64};
    std::vector<Frame> frames;
    for (const float k : powers) frames.push_back(in_unit(recorded, k));
    const auto session = session_of(frames);
    const auto request_of = [](std::size_t frame, const char* technique) {
        return Request{.variant = {.frame = frame}, .choices = chosen({technique})};
    };
    std::vector<ImageSet> truths;
    std::vector<Accuracy> judged;
    for (std::size_t i = 0; i < std::size(powers); ++i) {
        const Request request = request_of(i, "transparency/weighted");
        truths.push_back(must(session->truth(request, Stage::transparency)));
        judged.push_back(must(session->judge(request, Stage::transparency, Against::truth, &truths[i])));
        const PictureTruth picture = must(picture_truth(*session, request, Stage::transparency, truths[i]));
        must(judge_picture(*session, request, picture, judged[i]));
    }
    const ReferenceImage& plain = truths[0].at("color");
    ASSERT_GE(plain.alternatives.size(), 10u);
    ASSERT_GT(judged[0].undecided_bound.value().value, 0);
    for (std::size_t i = 1; i < std::size(powers); ++i) {
        const ReferenceImage& scaled = truths[i].at("color");
        ASSERT_EQ(scaled.alternatives.size(), plain.alternatives.size());
        for (std::size_t k = 0; k < plain.alternatives.size(); ++k)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(scaled.alternatives[k].value[c] / double(powers[i]), plain.alternatives[k].value[c], 1e-5);
        EXPECT_NEAR(judged[i].undecided_bound->value, judged[0].undecided_bound->value, 1e-5) << powers[i];
        for (std::size_t m = 0; m < judged[0].touched.size(); ++m)
            EXPECT_NEAR(judged[i].touched[m].value, judged[0].touched[m].value, 1e-4) << judged[0].touched[m].name << powers[i];
    }
}

/// The exposure alone changes the unit that radiance is stored in, not the radiance: of opaque and of transparent surfaces, lit,
/// unlit and emissive ones, of particles in light volumes, and of what is behind them.
TEST(UnitOfLight, ExhaustiveOfStorageIsNotThatOfImages) {
    for (const std::string_view scenario : {"night_market", "glass_and_smoke"}) {
        std::vector<Frame> frames(2, of_scenario(scenario));
        for (Frame& frame : frames) frame.lens = {};  // bloom begins at an exposed brightness
        frames[1].view.exposure *= 5;
        const auto session = session_of(frames);
        const std::vector<std::string> names{"emission", "light", "color"};
        auto was = must(session->run({.outputs = names})).images;
        auto is = must(session->run({.variant = {.frame = 1}, .outputs = names})).images;
        for (const auto& [name, image] : was) {
            const ReferenceImage a = in_double(image), b = in_double(is.at(name));
            double brightest = 0, worst = 0;
            for (std::size_t i = 0; i < a.texels.size(); ++i)
                for (int c = 0; c < 3; ++c) {
                    brightest = std::max(brightest, a.texels[i][c]);
                    worst = std::max(worst, apart(a.texels[i][c], b.texels[i][c], 1e-3));
                }
            if (name != "emission" || scenario == "night_market") {
                EXPECT_GT(brightest, 0) << scenario << " " << name << "; the comparison proves nothing";
            }
            EXPECT_LT(worst, 0x1p-9) << scenario << " " << name << ": halves round by 2^-11, twice";
        }
    }
}

double brightest_color(Session& session, std::size_t frame, const char* technique) {
    const auto run = session.run({.variant = {.frame = frame}, .choices = chosen({technique}), .outputs = {"color"}});
    double most = 0;
    for (const glm::dvec4& texel : in_double(must(run).images.at("color")).texels) most = std::max(most, texel.x);
    return most;
}

/// Surfaces that a lamp lights are stored as well whatever its range is: it lights the scene, not what lies at a quarter of the
/// range.
TEST(UnitOfLight, OfALampIsThatOfWhatItLights) {
    std::vector<Frame> frames;
    for (const float range : {100.f, 1e3f, 1e5f, 1e6f}) {
        frames.push_back(of_scenario("three_cards"));
        Frame& frame = frames.back();
        frame.view.exposure = 1e-5f;
        for (Material& material : frame.materials) material.lighting_model = LightingModel::lambert;
        frame.fog = {}, frame.hemisphere = {}, frame.sun = {}, frame.background = glm::vec3(0);
        frame.lights = {{.position = frame.view.origin, .intensity = glm::vec3(3e6f), .range = range}};
    }
    const auto session = session_of(frames);
    for (const char* technique : {"transparency/sorted_lists", "transparency/moments", "transparency/exact_function"}) {
        const double near = brightest_color(*session, 0, technique);
        EXPECT_GT(near, 1e3) << "a storage by the range would end at 1300 of it; the comparison proves nothing";
        for (std::size_t i = 1; i < frames.size(); ++i)
            EXPECT_NEAR(brightest_color(*session, i, technique) / near, 1, 2e-3)
                << technique << ", a range of " << frames[i].lights[0].range;
    }
}

/// Cards that shine a million times as bright as what is white are cut off, and counted.
TEST(UnitOfLight, FragmentsThatAreCutOffAreCounted) {
    std::vector<Frame> frames(2, of_scenario("three_cards"));
    for (Material& material : frames[1].materials) material.emissive = glm::vec3(1e6f);
    const auto session = session_of(frames);
    for (const char* technique : {"transparency/exact_function", "transparency/adaptive", "transparency/moments",
                                  "transparency/wavelet", "transparency/voxel"})
        for (const std::size_t frame : {0u, 1u}) {
            const auto run = must(session->run({.variant = {.frame = frame}, .choices = chosen({technique})}));
            const auto count = [&](std::string_view name) {
                return std::ranges::find(run.counters, name, &CounterRecord::name)->value;
            };
            EXPECT_GT(count("drawn"), 100) << technique;
            EXPECT_EQ(count("clamped"), frame == 0 ? 0 : count("drawn")) << technique;
        }
}

/// A card of alpha .5 in three suns, of a lamp's unit and of lux, by a recorded exposure and without one. No lights but the sun,
/// no sky: radiance is in proportion.
TEST(UnitOfLight, OfASunInLuxIsNoLimit) {
    std::vector<Frame> frames;
    for (const float lux : {3.f, 1e5f, 1e7f})
        for (const float exposure : {1.f, 1 / lux}) {
            frames.push_back(of_scenario("three_cards"));
            Frame& frame = frames.back();
            frame.view.exposure = exposure;
            for (Material& material : frame.materials) material.lighting_model = LightingModel::lambert;
            frame.lights.clear();
            frame.fog = {};
            frame.hemisphere = {};
            frame.background = glm::vec3(0);
            frame.sun = {.direction = glm::vec3(glm::transpose(frame.view.to_view) * glm::dvec3(0, 0, 1)),
                         .irradiance = glm::vec3(lux)};
        }
    const auto session = session_of(frames);
    for (const char* technique : {"transparency/sorted_lists", "transparency/moments", "transparency/exact_function"}) {
        const double in_unit_of_lamp = brightest_color(*session, 0, technique) / 3;
        EXPECT_GT(in_unit_of_lamp, .02) << "the sun does not show; the comparison proves nothing";
        for (std::size_t i = 1; i < frames.size(); ++i)
            EXPECT_NEAR(brightest_color(*session, i, technique) / double(frames[i].sun.irradiance.x) / in_unit_of_lamp, 1, 2e-3)
                << technique << ", " << frames[i].sun.irradiance.x << " lux, exposure " << frames[i].view.exposure;
    }
}

}  // namespace strata
