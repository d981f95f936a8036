// Whole images are handed on by equal shape; the heir waits for the previous owner.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/graph/graph.h"
#include "tests/2_graph/small_graphs.h"

namespace strata {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

/// a is written, sampled into b, and b is sampled into c: a and c are never alive together.
Graph chain(Shape shape_of_c = small_shape()) {
    Graph graph;
    Image a = graph.create("a", small_shape()), b = graph.create("b", small_shape()), c = graph.create("c", shape_of_c);
    graph.compute("write.comp").stores("target", a).over({64, 32});
    graph.compute("sample.comp").samples("source", a).stores("target", b).over({64, 32});
    graph.compute("sample.comp").samples("source", b).stores("target", c).over({64, 32});
    graph.keep(c);
    return graph;
}

TEST(Memory, ImagesNeverAliveTogetherShare) {
    const Plan plan = compiled(chain());
    ASSERT_EQ(plan.slots.size(), 2u);
    EXPECT_THAT(plan.slots[0].images, ElementsAre(0u, 2u));
    EXPECT_THAT(plan.slot_of_image, ElementsAre(0u, 1u, 0u));
    EXPECT_EQ(plan.image_bytes, 2u * 64 * 32 * 8);
}

TEST(Memory, AnHeirWaitsForThePreviousOwnerAndDiscards) {
    EXPECT_THAT(waits(compiled(chain()), 2), UnorderedElementsAre("b: stored -> sampled", "c: sampled -> stored, discarded"));
}

TEST(Memory, AnHeirOfLayersWaitsForWhatWasLastDoneToEachLayer) {
    Graph graph;
    Shape shape = small_shape();
    shape.layers = 2;
    Image a = graph.create("a", shape), b = graph.create("b", small_shape()), c = graph.create("c", shape);
    graph.clear(a, {});
    graph.compute("sample.comp").samples("source", a, Filter::nearest, {.layer = 1}).stores("target", b).over({64, 32});
    graph.clear(c, {});
    graph.keep(b);
    graph.keep(c);
    EXPECT_THAT(waits(compiled(graph), 2),
                ElementsAre("c layer 0: copied_to -> copied_to, discarded", "c layer 1: sampled -> copied_to, discarded"));
}

TEST(Memory, ImagesOfDifferentShapesDoNotShare) { EXPECT_EQ(compiled(chain(small_shape(Format::rgba32f))).slots.size(), 3u); }

TEST(Memory, AnImageReadAndOneWrittenInTheSameStepDoNotShare) {
    Graph graph;
    Image a = graph.create("a", small_shape()), b = graph.create("b", small_shape());
    graph.compute("write.comp").stores("target", a).over({64, 32});
    graph.compute("sample.comp").samples("source", a).stores("target", b).over({64, 32});
    graph.keep(b);
    EXPECT_EQ(compiled(graph).slots.size(), 2u);
}

TEST(Memory, WhatIsKeptIsNeverHandedOn) {
    Graph graph;
    Image a = graph.create("a", small_shape()), b = graph.create("b", small_shape());
    graph.compute("write.comp").stores("target", a).over({64, 32});
    graph.compute("write.comp").stores("target", b).over({64, 32});
    graph.keep(a);
    graph.keep(b);
    EXPECT_EQ(compiled(graph).slots.size(), 2u);
}

TEST(Memory, ImportsNeverShareAndAreNotCounted) {
    Graph graph;
    Image history = graph.import("history", small_shape(), ImportId{1}), a = graph.create("a", small_shape()),
          b = graph.create("b", small_shape());
    graph.compute("copy.comp").loads("source", history).stores("target", a).over({64, 32});
    graph.compute("copy.comp").loads("source", a).stores("target", b).over({64, 32});
    graph.keep(b);
    const Plan plan = compiled(graph);
    EXPECT_EQ(plan.slots.size(), 2u);
    EXPECT_EQ(plan.slot_of_image[0], 0xffffffffu);
}

TEST(Memory, WhatIsLeftOutNeedsNone) {
    Graph graph;
    Image a = graph.create("a", small_shape()), kept = graph.create("kept", small_shape());
    Buffer list = graph.create("list", 1000);
    graph.compute("write.comp").stores("target", a).over({64, 32});
    graph.compute("fill_list.comp").stores("List", list).over({1});
    graph.compute("write.comp").stores("target", kept).over({64, 32});
    graph.keep(kept);
    const Plan plan = compiled(graph);
    EXPECT_EQ(plan.slots.size(), 1u);
    EXPECT_EQ(plan.slot_of_image[a.id], 0xffffffffu);
    EXPECT_TRUE(plan.used_buffers.empty());
    EXPECT_EQ(plan.buffer_bytes, 0u);
}

TEST(Memory, BytesCountMipsLayersAndSamples) {
    EXPECT_EQ(bytes({.extent = {4, 2}, .format = Format::r32f}), 32u);
    EXPECT_EQ(bytes({.extent = {4, 2}, .format = Format::r32f, .layers = 3, .mips = 3}), 3u * 4 * (8 + 2 + 1));
    EXPECT_EQ(bytes({.extent = {4, 2}, .format = Format::rgba16f, .samples = 4}), 4u * 8 * 8);
}

}  // namespace
}  // namespace strata
