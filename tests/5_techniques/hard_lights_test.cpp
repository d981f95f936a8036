// Lights and places that break a careless renderer, through every technique of the stage (docs/algorithms/lighting.md 7: N7, N18,
// N21).
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "tests/5_techniques/light_scenes.h"
#include "tests/support/not_finite.h"
#include "tests/support/print.h"
#include "tests/support/similar_frame.h"

namespace strata {
namespace {

class HardLights : public testing::TestWithParam<const Technique*> {
protected:
    strata::Run lit_by(const Frame& frame) { return lit(frame, std::string(GetParam()->name)); }
};

Frame room() {
    Frame frame = at_most_96("lights_room", 1);
    frame.view.width = 64, frame.view.height = 36;
    return frame;
}

Light lamp(LightType type, const glm::dvec3& position) {
    Light light;
    light.type = type;
    light.position = position;
    light.intensity = glm::vec3(100);
    return light;
}

TEST_P(HardLights, ThatReachNothingAddNothing) {  // docs/algorithms/lighting.md N7
    const Frame without = room();
    Frame with = without;
    const glm::dvec3 middle = to_world(without, {0, 0, 5});
    for (const LightType type : {LightType::omni, LightType::round_spot, LightType::square_spot, LightType::tube,
                                 LightType::sphere, LightType::disc, LightType::rectangle}) {
        Light light = lamp(type, middle);
        light.source_radius = .1f, light.half_extent = {.2f, .1f};
        light.range = 0;
        with.lights.push_back(light);
        light.position = without.view.origin;
        light.range = .5f * without.view.near;
        light.intensity = glm::vec3(.01f);  // as bright as the room where it reaches, so that light is stored in the same unit
        with.lights.push_back(light);
    }
    const auto dark = lit_by(without), same = lit_by(with);
    EXPECT_EQ(differing_texels(same, dark), 0u);
    EXPECT_GT(lit_texels(dark), 500u) << "nothing to compare";
}

TEST_P(HardLights, WithoutAnExtentAddNothing) {  // docs/algorithms/lighting.md N7: radiance of no area
    const Frame without = room();
    Frame with = without;
    for (const LightType type : {LightType::tube, LightType::sphere, LightType::disc, LightType::rectangle})
        with.lights.push_back(lamp(type, to_world(without, {0, .5, 4})));
    EXPECT_EQ(differing_texels(lit_by(with), lit_by(without)), 0u);
}

TEST_P(HardLights, OnSmoothSurfacesAreNumbersThatAHalfFloatHolds) {  // docs/algorithms/lighting.md N21
    Frame frame = room();
    for (Material& material : frame.materials) material.lighting_model = LightingModel::ggx, material.roughness = 0;
    const Mesh& mesh = frame.meshes[frame.draws[0].mesh];
    const glm::dvec3 corner = frame.draws[0].to_world * glm::dvec4(mesh.positions[0], 1);
    for (const LightType type :
         {LightType::omni, LightType::round_spot, LightType::sphere, LightType::tube, LightType::rectangle}) {
        for (const glm::dvec3& place : {corner, to_world(frame, {0, -.5, 3}), frame.view.origin}) {
            Light light = lamp(type, place);
            light.intensity = glm::vec3(1e8f);
            light.source_radius = 1e-4f, light.half_extent = glm::vec2(1e-4f);
            light.range = 100;
            frame.lights.push_back(light);
        }
    }
    const auto run = lit_by(frame);
    EXPECT_EQ(texel_that_is_no_number(run.images.at("light")), std::nullopt);
    double brightest = 0;
    for (const glm::dvec4& texel : in_double(run.images.at("light")).texels)
        brightest = std::max({brightest, texel.x, texel.y, texel.z});
    EXPECT_GT(brightest, 1e3) << "no highlight to break anything";
}

TEST_P(HardLights, TenKilometersFromTheOriginAreLitTheSame) {  // docs/algorithms/lighting.md N18: within 1e-3
    for (const std::string_view scenario : {"blocker_rooms", "light_types"}) {
        const Frame here = at_most_96(scenario, 1);
        const ReferenceImage near = in_double(lit_by(here).images.at("light"));
        const ReferenceImage far = in_double(lit_by(similar(here, {.shift = {7.1e3, -300.3, 7.0e3}})).images.at("light"));
        double squares = 0, differences = 0;
        for (std::size_t i = 0; i < near.texels.size(); ++i) {
            const glm::dvec3 difference = near.texels[i] - far.texels[i], light = near.texels[i];
            squares += glm::dot(light, light);
            differences += glm::dot(difference, difference);
        }
        EXPECT_GT(squares, 0) << scenario;
        EXPECT_LT(std::sqrt(differences / squares), 1e-3) << scenario;
    }
}

INSTANTIATE_TEST_SUITE_P(Lighting, HardLights, testing::ValuesIn(techniques_of(Stage::lighting)),
                         [](const auto& tested) { return as_identifier(std::string(tested.param->name)); });

}  // namespace
}  // namespace strata
