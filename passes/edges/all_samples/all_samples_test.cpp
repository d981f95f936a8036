// Facts of shading every sample, and of what the stage calls an edge.
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/edges/judge.h"
#include "passes/edges/truth.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::edges {

Technique all_samples();

namespace {

struct Input {
    Frame frame;
    ImageSet before;
};

// 4 x 1 pixels of 4 samples: plain, two surfaces, half covered, background.
Input four_pixels() {
    Input input;
    input.frame.view.width = 4;
    input.frame.view.height = 1;
    input.frame.view.samples = 4;
    ReferenceImage depth(4, 1, 4, glm::dvec4(0.5, 0, 0, 1)), surface(4, 1, 4, glm::dvec4(0.25));
    surface.at(1, 0, 3).x = 0.75;
    depth.at(2, 0, 1).x = depth.at(2, 0, 2).x = 0;
    for (std::uint32_t sample = 0; sample < 4; ++sample) depth.at(3, 0, sample).x = 0;
    input.before = {{"depth_layers", depth}, {"gbuffer0", surface}};
    return input;
}

}  // namespace

TEST(edges, are_pixels_whose_samples_hold_different_surfaces_or_are_partly_covered) {
    const Input input = four_pixels();
    const ImageSet truth = edges_truth({input.frame, input.before});
    const ReferenceImage& edges = truth.at("edges");
    EXPECT_EQ(edges.at(0, 0).x, 0);
    EXPECT_EQ(edges.at(1, 0).x, 1);
    EXPECT_EQ(edges.at(2, 0).x, 1);
    EXPECT_EQ(edges.at(3, 0).x, 0);
}

TEST(every_sample, misses_no_edge_and_needlessly_shades_all_other_pixels) {
    const Input input = four_pixels();
    const Technique technique = all_samples();
    const StageInput stage{input.frame, input.before};
    const ImageSet result = technique.model(stage, Settings(technique.params));
    const auto metrics = edges_judge(result, edges_truth(stage), stage);
    EXPECT_EQ(metrics[0].name, "missed");
    EXPECT_EQ(metrics[0].value, 0);
    EXPECT_EQ(metrics[1].value, 50);
    EXPECT_EQ(metrics[2].value, 100);
}

}  // namespace strata::edges
