// The talk's light buffer on the device: its table of materials and white highlights, on all lighting models and under colored
// lights.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/support/agreement.h"

namespace strata {
namespace {

/// The scenario by its sun, with a red lamp and a blue spot at the eye.
Frame under_colored_lights(std::string_view scenario) {
    Frame frame = scenario_frames(scenario).front();
    const glm::dvec3 forward = glm::transpose(frame.view.to_view) * glm::dvec3(0, 0, 1);
    Light lamp;
    lamp.type = LightType::omni;
    lamp.position = frame.view.origin;
    lamp.intensity = {12, 2, 1};
    lamp.range = 30;
    Light spot = lamp;
    spot.type = LightType::round_spot;
    spot.direction = forward;
    spot.intensity = {1, 3, 15};
    spot.inner_angle = .1f;
    spot.outer_angle = .3f;
    frame.lights = {lamp, spot};
    return frame;
}

struct LightBufferCase {
    const char* scenario;
    std::vector<std::string> sets;
};

bool makes_a_table(const Run& run) {
    return std::ranges::any_of(run.steps,
                               [](const StepRecord& step) { return step.name.find("material_table") != step.name.npos; });
}

}  // namespace

TEST(LightBuffer, IsWhatTheModelSaysOnAllModelsUnderColoredLights) {
    const Technique& technique = *must(find_technique("lighting/brute_force"));
    for (const LightBufferCase& c : {LightBufferCase{"materials", {"materials=table"}},
                                     {"lighting_models", {"specular=white"}},
                                     {"lighting_models", {"materials=table", "specular=white"}}}) {
        SCOPED_TRACE(c.scenario + testing::PrintToString(c.sets));
        const auto session = session_of(std::vector<Frame>{under_colored_lights(c.scenario)});
        const Request request{.choices = chosen({}, c.sets)};
        const Accuracy accuracy = must(session->judge(request, Stage::lighting, Against::model));
        expect_within_tolerance(accuracy, technique, request);
        EXPECT_LT(accuracy.undecided, accuracy.compared / 2);
        EXPECT_GE(accuracy.compared - accuracy.trivial, 1000u);
    }
}

TEST(LightBuffer, HasATableOnlyWhereItIsAskedFor) {
    Session& session = session_of_scenarios();
    Request request = on_scenario("materials");
    request.outputs = {"light"};
    EXPECT_FALSE(makes_a_table(must(session.run(request))));
    request.choices = chosen({}, {"materials=table"});
    EXPECT_TRUE(makes_a_table(must(session.run(request))));
}

}  // namespace strata
