// Lights that end as those of glTF do: whatever is lit by them on the device is lit as the reference says.
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "capture_format/light_types.h"
#include "passes/registry.h"
#include "tests/5_techniques/light_scenes.h"
#include "tests/support/agreement.h"
#include "tests/support/print.h"

namespace strata {
namespace {

struct Lit {
    std::string technique;
    std::string_view scenario;
};
void PrintTo(const Lit& lit, std::ostream* out) { *out << lit.technique; }

/// A light of each type that ends; much lies in the outer half of its range, where the windows differ most.
Frame with_lights_that_end_as(const Lit& lit, RangeWindow window) {
    Frame frame = dark_frame(lit.scenario);
    frame.view.width = 32, frame.view.height = 18;
    RandomLights lights(5);
    for (const LightTypeFacts& facts : light_type_table) {
        if (!has_range(facts.type)) continue;
        Light light = lights.light(frame, facts.type, 6);
        light.window = window;
        light.source_radius = .2f, light.half_extent = {.4f, .3f};
        frame.lights.push_back(light);
    }
    return frame;
}

class LightsOfGltf : public testing::TestWithParam<Lit> {};

TEST_P(LightsOfGltf, LightAsTheReferenceSays) {
    const Technique& technique = *must(find_technique(GetParam().technique));
    const Request request{.choices = chosen({GetParam().technique})};
    const auto session = session_of(std::vector{with_lights_that_end_as(GetParam(), RangeWindow::quartic)});
    const Accuracy accuracy = must(session->judge(request, technique.stage, Against::model));
    expect_within_tolerance(accuracy, technique, request);
    EXPECT_GE(accuracy.compared - accuracy.trivial, 100u);
}

INSTANTIATE_TEST_SUITE_P(Places, LightsOfGltf,
                         testing::Values(Lit{"lighting/brute_force", "lights_room"}, Lit{"lighting/tiled", "lights_room"},
                                         Lit{"indirect/lpv", "cornell_box"},
                                         Lit{"transparency/sorted_lists", "red_and_green_glass"}),
                         [](const auto& tested) { return as_identifier(tested.param.technique); });

}  // namespace
}  // namespace strata
