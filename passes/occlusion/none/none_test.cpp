// Facts of leaving ambient light as it is.
#include <algorithm>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::occlusion {

Technique none();
ImageSet none_model(const StageInput&, const Settings&);

TEST(NoOcclusion, LetsAllLightReachEverySample) {
    const ReferenceImage visible = none_model({one_pixel(4), {}}, {}).at("occlusion");
    EXPECT_EQ(visible.layers, 4u);
    EXPECT_TRUE(std::ranges::all_of(visible.texels, [](const glm::dvec4& texel) { return texel.x == 1; }));
}

TEST(NoOcclusion, DeclaresNothingBeforeTheStagesThatReadIt) {
    Graph graph;
    FrameImages images;
    images.extent = {8, 4};
    const Technique technique = none();
    technique.declare(graph, images, Settings(technique.params));
    EXPECT_FALSE(images.occlusion);
    EXPECT_TRUE(graph.steps().empty());
}

TEST(NoOcclusion, MakesOnesAtTheEndForWhoeverAsks) {
    Graph graph;
    FrameImages images;
    images.extent = {8, 4};
    images.samples = 4;
    const Technique technique = none();
    ASSERT_EQ(technique.at_other_stages.size(), 1u);
    EXPECT_GT(technique.at_other_stages[0].at, Stage::transparency) << "the last stage that could read it";
    technique.at_other_stages[0].declare(graph, images, Settings(technique.params));
    EXPECT_EQ(graph.shape(images.occlusion).layers, 4u);
    ASSERT_EQ(graph.steps().size(), 1u);
    EXPECT_TRUE(std::holds_alternative<ClearWork>(graph.steps().front().work));
}

}  // namespace strata::occlusion
