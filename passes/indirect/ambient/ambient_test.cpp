// Facts of light that does not bounce.
#include <algorithm>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::indirect {

Technique ambient();
ImageSet ambient_model(const StageInput&, const Settings&);

TEST(Ambient, AddsNothingAtAnySample) {
    const ReferenceImage light = ambient_model({one_pixel(4), {}}, {}).at("indirect");
    EXPECT_EQ(light.layers, 4u);
    EXPECT_TRUE(std::ranges::all_of(light.texels, [](const glm::dvec4& texel) { return texel == glm::dvec4(0); }));
}

TEST(Ambient, ClearsAnImageAndDoesNoMore) {
    Graph graph;
    FrameImages images;
    images.extent = {8, 4};
    images.samples = 4;
    const Technique technique = ambient();
    technique.declare(graph, images, Settings(technique.params));
    EXPECT_EQ(graph.shape(images.indirect).layers, 4u);
    ASSERT_EQ(graph.steps().size(), 1u);
    EXPECT_TRUE(std::holds_alternative<ClearWork>(graph.steps().front().work));
}

}  // namespace strata::indirect
