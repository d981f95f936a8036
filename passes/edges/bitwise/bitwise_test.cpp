// Facts of comparing words, on the model: what makes two samples one surface.
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/edges/truth.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::edges {

Technique bitwise();

namespace {

/// A pixel of one surface.
ImageSet one_surface() {
    return {{"depth_layers", ReferenceImage(1, 1, 4, glm::dvec4(.5, 0, 0, 1))},
            {"gbuffer0", ReferenceImage(1, 1, 4, glm::dvec4(.25))},
            {"gbuffer1", ReferenceImage(1, 1, 4, glm::dvec4(.75))},
            {"emission", ReferenceImage(1, 1, 4, glm::dvec4(0, 0, 0, 1))}};
}

struct MarkAndTruth {
    double mark = 0, truth = 0;
};

MarkAndTruth mark_and_truth(const ImageSet& before) {
    const Frame frame = one_pixel(4);
    const Technique technique = bitwise();
    const StageInput input{frame, before};
    return {technique.model(input, Settings(technique.params)).at("edges").at(0, 0).x, edges_truth(input).at("edges").at(0, 0).x};
}

double mark_of(const ImageSet& before) {
    const auto [mark, truth] = mark_and_truth(before);
    EXPECT_EQ(mark, truth) << "where words hold the depth it is the stage's truth";
    return mark;
}

TEST(BitwiseEdges, APixelOfOneSurfaceIsPlain) { EXPECT_EQ(mark_of(one_surface()), 0); }

TEST(BitwiseEdges, AnyBitOfAnyWordOfAnySampleMakesAnEdge) {
    for (const std::string_view image : {"gbuffer0", "gbuffer1", "emission"})
        for (std::uint32_t sample = 0; sample < 4; ++sample)
            for (int channel = 0; channel < 4; ++channel) {
                ImageSet before = one_surface();
                double& word = before.find(image)->second.at(0, 0, sample)[channel];
                word = std::nextafter(word, 2);
                EXPECT_EQ(mark_of(before), 1) << image << " sample " << sample << " channel " << channel;
            }
}

// The packed layout keeps the side that a normal faces in the sign of a zero.
TEST(BitwiseEdges, ZerosOfBothSignsAreDifferentWords) {
    ImageSet before = one_surface();
    for (std::uint32_t sample = 0; sample < 4; ++sample) before.at("gbuffer0").at(0, 0, sample).x = sample == 2 ? -0. : 0.;
    EXPECT_EQ(mark_of(before), 1);
}

TEST(BitwiseEdges, MissStepsOfDepthThatWordsDoNotHold) {
    ImageSet before = one_surface();
    before.at("depth_layers").at(0, 0, 1).x = .51;  // the frame has no plane that explains it
    const auto [mark, truth] = mark_and_truth(before);
    EXPECT_EQ(mark, 0);
    EXPECT_EQ(truth, 1);
}

TEST(BitwiseEdges, APixelThatIsPartlyCoveredIsAnEdgeAndTheSkyIsPlain) {
    ImageSet before = one_surface();
    before.at("depth_layers").at(0, 0, 3).x = 0;
    EXPECT_EQ(mark_of(before), 1);
    for (auto& [name, image] : before) image = ReferenceImage(1, 1, 4);
    EXPECT_EQ(mark_of(before), 0);
}

}  // namespace
}  // namespace strata::edges
