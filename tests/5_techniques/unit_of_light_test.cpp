// Light in any unit: a frame with k times the light and 1 / k of the exposure is the same picture, and every technique is as far
// off in it as before. The scaling here is the test's own, and truths in the recorded unit are checked by what they sum to.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
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

/// Figures of every unit against those of the recorded one; radiance is in the frame's unit.
void expect_the_same_figures(const std::vector<Metric>& got, const std::vector<Metric>& wanted, float k, const std::string& of) {
    ASSERT_EQ(got.size(), wanted.size()) << of;
    for (std::size_t i = 0; i < got.size(); ++i) {
        const double unit = wanted[i].unit == "radiance" ? double(k) : 1;
        // 1e-3 of an error, and what float rounding of the scaled light itself makes of one: 2^-20.
        const double difference = apart(got[i].value / unit, wanted[i].value, 0x1p-20 * 1e3);
        EXPECT_LE(difference, 1e-3) << of << ", " << got[i].name << ": " << got[i].value / unit << ", was " << wanted[i].value;
    }
}

void expect_errors_in_any_unit(std::string_view scenario, const std::vector<std::string_view>& names) {
    const Frame recorded = of_scenario(scenario);
    std::vector<Frame> frames{recorded};
    for (const float k : units) frames.push_back(in_unit(recorded, k));
    const auto session = session_of(frames);
    for (const std::string_view name : names) {
        const Technique& technique = *must(find_technique(name));
        std::vector<Metric> wanted;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const Request request{.variant = {.frame = i}, .choices = chosen({std::string(name)})};
            const auto accuracy = session->judge(request, technique.stage, Against::truth);
            ASSERT_TRUE(accuracy) << name << ": " << accuracy.error().sentence;
            if (i == 0) wanted = accuracy->technique_errors;
            else
                expect_the_same_figures(accuracy->technique_errors, wanted, units[i - 1],
                                        fmt::format("{} {} at {} times the light", scenario, name, units[i - 1]));
        }
    }
}

/// Every technique of the stages that the frame needs.
std::vector<std::string_view> techniques_for(std::string_view scenario) {
    const auto session = session_of({of_scenario(scenario)});
    const auto plan = must(session->plan({}));
    std::vector<std::string_view> names;
    for (const Technique& technique : techniques())
        if (std::ranges::count(plan.skipped, technique.stage, &SkippedStage::stage) == 0) names.push_back(technique.name);
    return names;
}

}  // namespace

TEST(UnitOfLight, LeavesTheErrorsOfTechniquesThatStoreLight) {
    expect_errors_in_any_unit("glass_and_smoke", {"transparency/weighted", "transparency/moments", "lighting/tiled"});
}

TEST(UnitOfLight, ExhaustiveLeavesEveryError) {
    for (const std::string_view scenario : {"night_market", "courtyard", "hall_with_shafts", "zone_at_dusk", "roof_in_rain"})
        expect_errors_in_any_unit(scenario, techniques_for(scenario));
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
    const auto brightest = [&](std::size_t frame, const char* technique) {
        const auto run = session->run({.variant = {.frame = frame}, .choices = chosen({technique}), .outputs = {"color"}});
        double most = 0;
        for (const glm::dvec4& texel : in_double(must(run).images.at("color")).texels) most = std::max(most, texel.x);
        return most;
    };
    for (const char* technique : {"transparency/sorted_lists", "transparency/moments", "transparency/exact_function"}) {
        const double in_unit_of_lamp = brightest(0, technique) / 3;
        EXPECT_GT(in_unit_of_lamp, .02) << "the sun does not show; the comparison proves nothing";
        for (std::size_t i = 1; i < frames.size(); ++i)
            EXPECT_NEAR(brightest(i, technique) / double(frames[i].sun.irradiance.x) / in_unit_of_lamp, 1, 2e-3)
                << technique << ", " << frames[i].sun.irradiance.x << " lux, exposure " << frames[i].view.exposure;
    }
}

}  // namespace strata
