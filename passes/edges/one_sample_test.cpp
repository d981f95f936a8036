// What every technique of the stage does where pixels have one sample.
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/registry.h"
#include "passes/technique.h"

namespace strata::edges {
namespace {

TEST(Edges, OfPixelsWithOneSampleAreNoneWhicheverTechniqueIsForcedOn) {
    std::size_t tested = 0;
    for (const Technique& technique : techniques()) {
        if (technique.stage != Stage::edges) continue;
        Graph graph;
        FrameImages images;
        technique.declare(graph, images, Settings(technique.params));
        EXPECT_FALSE(images.edges) << technique.name;
        EXPECT_TRUE(graph.steps().empty()) << technique.name;
        ++tested;
    }
    EXPECT_GE(tested, 6u);
}

}  // namespace
}  // namespace strata::edges
