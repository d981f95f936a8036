// The hemisphere through the talk's table of materials, on the device: all lighting models, and frames that have no hemisphere.
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

/// The scenario without its other lights.
Frame under_the_sky(std::string_view scenario, glm::vec3 sky) {
    Frame frame = scenario_frames(scenario).front();
    frame.sun.irradiance = glm::vec3(0);
    frame.lights.clear();
    frame.hemisphere = {.sky = sky, .ground = .3f * sky};
    return frame;
}

}  // namespace

TEST(HemisphereByTable, IsWhatTheModelSaysOnAllLightingModels) {
    const Technique& technique = *must(find_technique("combine/hi_lo"));
    for (const char* scenario : {"materials", "lighting_models"}) {
        SCOPED_TRACE(scenario);
        const auto session = session_of(std::vector<Frame>{under_the_sky(scenario, {.5f, .7f, 1})});
        const Request request{.choices = chosen({}, {"hemisphere=table"})};
        const Accuracy accuracy = must(session->judge(request, Stage::combine, Against::model));
        expect_within_tolerance(accuracy, technique, request);
        EXPECT_LT(accuracy.undecided, accuracy.compared / 3);
        EXPECT_GE(accuracy.compared - accuracy.trivial, 1000u);
    }
}

TEST(HemisphereByTable, HasATableOnlyWhereThereIsAHemisphere) {
    for (const float sky : {0.f, 1.f}) {
        const auto session = session_of(std::vector<Frame>{under_the_sky("materials", glm::vec3(sky))});
        const auto run = must(session->run({.choices = chosen({}, {"hemisphere=table"}), .outputs = {"color"}}));
        const bool makes_table = std::ranges::any_of(
            run.steps, [](const StepRecord& step) { return step.name.find("material_table") != std::string::npos; });
        EXPECT_EQ(makes_table, sky > 0);
    }
}

}  // namespace strata
