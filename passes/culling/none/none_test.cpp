// Facts of not culling.
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/technique.h"

namespace strata::culling {

Technique none();

TEST(no_culling, draws_what_the_frame_holds_and_copies_nothing) {
    Graph graph;
    FrameImages images;
    images.all_opaque = {
        .commands = graph.create("commands", 40), .indices = graph.create("indices", 12), .first = 3, .count = 2};
    const Technique technique = none();
    technique.declare(graph, images, Settings(technique.params));
    EXPECT_EQ(images.opaque.commands, images.all_opaque.commands);
    EXPECT_EQ(images.opaque.first, 3u);
    EXPECT_EQ(images.opaque.count, 2u);
    ASSERT_EQ(graph.steps().size(), 1u);
    EXPECT_TRUE(std::holds_alternative<ClearWork>(graph.steps().front().work));
}

}  // namespace strata::culling
