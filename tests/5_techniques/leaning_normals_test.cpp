// Normals that lean away from the eye: mapped ones, and those extrapolated beyond an edge at 4 samples. GGX is defined there too.

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "captures/cards.h"
#include "passes/registry.h"
#include "tests/support/agreement.h"
#include "tests/support/print.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// A card facing the eye whose normals point behind it and to the left; the sun shines from behind, almost at the eye. The half
/// vector then is opposite to the normal, where |n x h| is as small as inside a highlight.
Frame leaning_card() {
    Frame frame = frame_of_cards(std::vector<Card>{{.center = {0, 0, 5}, .half = 4}}, 16);
    frame.meshes[0].indices = {0, 2, 1, 0, 3, 2};  // cards show their backs, which opaque draws would not
    Material& material = frame.materials[0];
    material.lighting_model = LightingModel::ggx;
    material.alpha_mode = AlphaMode::opaque;
    material.double_sided = false;
    material.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1);
    material.roughness = 0.3f;
    for (glm::vec3& normal : frame.meshes[0].normals) normal = glm::normalize(glm::vec3(-0.95f, 0, 0.31f));
    frame.sun.direction = glm::normalize(glm::vec3(-0.1f, 0, -1));
    frame.sun.irradiance = glm::vec3(3);
    return frame;
}

class LeaningNormals : public testing::TestWithParam<const Technique*> {};

TEST_P(LeaningNormals, AreLitAsTheModelSays) {
    const Technique& technique = *GetParam();
    const auto session = session_of(std::vector<Frame>{leaning_card()});
    const Request request{.choices = chosen({std::string(technique.name)})};
    const Accuracy accuracy = must(session->judge(request, Stage::lighting, Against::model));
    expect_within_tolerance(accuracy, technique, request);
    EXPECT_LT(accuracy.trivial, accuracy.compared) << "the card must be in the picture";
    EXPECT_GT(accuracy.worst.wanted.x, 0) << "and lit";
}

INSTANTIATE_TEST_SUITE_P(Lighting, LeaningNormals, testing::ValuesIn(techniques_of(Stage::lighting)),
                         [](const auto& tested) { return as_identifier(std::string(tested.param->name)); });

}  // namespace
}  // namespace strata
