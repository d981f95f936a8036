// One rule: every use waits for the previous one, except repeating the same read. The CPU driver runs commands one after the
// other and the validation layer does not see attachments, so this is where barriers are proven.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/graph/graph.h"
#include "tests/2_graph/small_graphs.h"

namespace strata {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// Images a, b and c; a has been written by step 0.
struct Written {
    Graph graph;
    Image a = graph.create("a", small_shape()), b = graph.create("b", small_shape()), c = graph.create("c", small_shape());
    Written() {
        graph.compute("write.comp").stores("target", a).over({64, 32});
        graph.keep(a);
        graph.keep(b);
        graph.keep(c);
    }
    void sample_a_into(Image& target) {
        graph.compute("sample.comp").samples("source", a).stores("target", target).over({64, 32});
    }
    void load_a_into(Image& target) { graph.compute("copy.comp").loads("source", a).stores("target", target).over({64, 32}); }
};

TEST(Barriers, TheFirstUseStartsFromNothingAndDiscards) {
    Graph graph;
    Image a = graph.create("a", small_shape());
    graph.compute("write.comp").stores("target", a).over({64, 32});
    graph.keep(a);
    EXPECT_THAT(waits(compiled(graph), 0), ElementsAre("a: none -> stored, discarded"));
}

TEST(Barriers, AReadAfterAWriteWaits) {
    Written frame;
    frame.sample_a_into(frame.b);
    frame.load_a_into(frame.c);
    EXPECT_THAT(waits(compiled(frame.graph), 1), UnorderedElementsAre("a: stored -> sampled", "b: none -> stored, discarded"));
}

TEST(Barriers, TwoReadsOfTheSameKindDoNot) {
    Written frame;
    frame.sample_a_into(frame.b);
    frame.sample_a_into(frame.c);
    EXPECT_THAT(waits(compiled(frame.graph), 2), ElementsAre("c: none -> stored, discarded"));
}

TEST(Barriers, TwoReadsOfDifferentKindsDo) {
    Written frame;
    frame.sample_a_into(frame.b);
    frame.load_a_into(frame.c);
    EXPECT_THAT(waits(compiled(frame.graph), 2), UnorderedElementsAre("a: sampled -> loaded", "c: none -> stored, discarded"));
}

TEST(Barriers, AWriteAfterAReadWaits) {
    Written frame;
    frame.sample_a_into(frame.b);
    frame.load_a_into(frame.c);
    frame.graph.compute("write.comp").stores("target", frame.a).over({64, 32});
    EXPECT_THAT(waits(compiled(frame.graph), 3), ElementsAre("a: loaded -> stored"));
}

TEST(Barriers, AnUpdateAfterAnUpdateWaits) {
    Graph graph;
    Image a = graph.create("a", small_shape());
    graph.clear(a, {});
    graph.compute("change.comp").updates("target", a).over({64, 32});
    graph.compute("change.comp").updates("target", a).over({64, 32});
    graph.keep(a);
    const Plan plan = compiled(graph);
    EXPECT_THAT(waits(plan, 1), ElementsAre("a: copied_to -> updated"));
    EXPECT_THAT(waits(plan, 2), ElementsAre("a: updated -> updated"));
}

TEST(Barriers, PingPongWaitsEveryIteration) {
    Graph graph;
    Image ping = graph.create("ping", small_shape()), pong = graph.create("pong", small_shape());
    graph.clear(ping, {});
    for (int i = 0; i < 3; ++i) {
        graph.compute("sample.comp").samples("source", ping).stores("target", pong).over({64, 32});
        graph.compute("sample.comp").samples("source", pong).stores("target", ping).over({64, 32});
    }
    graph.keep(ping);
    const Plan plan = compiled(graph);
    for (std::size_t step = 2; step < plan.steps.size(); ++step)
        EXPECT_THAT(waits(plan, step),
                    UnorderedElementsAre("ping: " + std::string(step % 2 ? "stored -> sampled" : "sampled -> stored"),
                                         "pong: " + std::string(step % 2 ? "sampled -> stored" : "stored -> sampled")));
}

TEST(Barriers, AMipChainWaitsMipByMipAndEndsInOneBarrierPerState) {
    Graph graph;
    Shape shape = small_shape();
    shape.mips = 3;
    Image chain = graph.create("chain", shape);
    graph.compute("write.comp").stores("target", chain, {.mip = 0}).over({64, 32});
    for (std::uint32_t mip = 1; mip < 3; ++mip)
        graph.compute("sample.comp")
            .samples("source", chain, Filter::nearest, {.mip = mip - 1})
            .stores("target", chain, {.mip = mip})
            .over({64u >> mip, 32u >> mip});
    graph.keep(chain);
    const Plan plan = compiled(graph);
    EXPECT_THAT(waits(plan, 0), ElementsAre("chain mip 0: none -> stored, discarded"));
    EXPECT_THAT(waits(plan, 1), ElementsAre("chain mip 0: stored -> sampled", "chain mip 1: none -> stored, discarded"));
    EXPECT_THAT(waits(plan, 2), ElementsAre("chain mip 1: stored -> sampled", "chain mip 2: none -> stored, discarded"));
    EXPECT_THAT(final_waits(plan), ElementsAre("chain mip 0: sampled -> copied_from", "chain mip 1: sampled -> copied_from",
                                               "chain mip 2: stored -> copied_from"));
}

TEST(Barriers, LayersWaitAloneAndTogetherWhenTheirStatesAgree) {
    Graph graph;
    Shape shape = small_depth();
    shape.layers = 2;
    Image maps = graph.create("maps", shape);
    graph.clear(maps, {});
    const DrawList list{graph.import("commands", 20, ImportId{1}), graph.import("indices", 12, ImportId{2}), 0, 1};
    for (std::uint32_t layer = 0; layer < 2; ++layer) graph.draw("depth_only", list).writes_depth(maps, {.layer = layer});
    graph.keep(maps);
    const Plan plan = compiled(graph);
    EXPECT_THAT(waits(plan, 0), ElementsAre("maps: none -> copied_to, discarded"));
    EXPECT_THAT(waits(plan, 1), ElementsAre("maps layer 0: copied_to -> depth_written"));
    EXPECT_THAT(waits(plan, 2), ElementsAre("maps layer 1: copied_to -> depth_written"));
    EXPECT_THAT(final_waits(plan), ElementsAre("maps: depth_written -> copied_from"));
}

TEST(Barriers, TestingDepthAgainstAnImageThatIsSampledIsOneBarrierToBoth) {
    Graph graph;
    Image depth = graph.create("depth", small_depth()), color = graph.create("color", small_shape());
    graph.clear(depth, {});
    const DrawList list{graph.import("commands", 20, ImportId{1}), graph.import("indices", 12, ImportId{2}), 0, 1};
    for (int i = 0; i < 2; ++i) graph.draw("shade", list).samples("source", depth).tests_depth(depth).covers(color);
    graph.keep(color);
    const Plan plan = compiled(graph);
    EXPECT_THAT(waits(plan, 1),
                UnorderedElementsAre("depth: copied_to -> sampled and depth_tested", "color: none -> color_written, discarded"));
    EXPECT_THAT(waits(plan, 2), ElementsAre("color: color_written -> color_written"));
    const AccessSet both = accesses(plan.steps[1], depth, {});
    EXPECT_TRUE(both.has(Access::sampled) && both.has(Access::depth_tested));
}

TEST(Barriers, IndirectArgumentsWaitForTheStepThatWritesThem) {
    Graph graph;
    Buffer list = graph.create("list", 64);
    Image a = graph.create("a", small_shape());
    graph.compute("fill_list.comp").stores("List", list).over({1});
    graph.compute("write.comp").stores("target", a).indirect(list);
    graph.compute("use_list.comp").loads("List", list).stores("target", a).indirect(list, 12);
    graph.keep(a);
    const Plan plan = compiled(graph);
    EXPECT_THAT(waits(plan, 0), IsEmpty());
    EXPECT_THAT(waits(plan, 1), UnorderedElementsAre("list: stored -> indirect", "a: none -> stored, discarded"));
    EXPECT_THAT(waits(plan, 2), UnorderedElementsAre("list: indirect -> loaded and indirect", "a: stored -> stored"));
}

TEST(Barriers, CulledDrawCommandsAreReadAsArgumentsAndTheirIndicesAsIndices) {
    Graph graph;
    Buffer commands = graph.create("commands", 20), indices = graph.create("indices", 12);
    graph.compute("fill_list.comp").stores("List", commands).over({1});
    graph.compute("fill_list.comp").stores("List", indices).over({1});
    Image color = graph.create("color", small_shape());
    graph.draw("paint", {commands, indices, 0, 1}).covers(color);
    graph.keep(color);
    EXPECT_THAT(waits(compiled(graph), 2), UnorderedElementsAre("commands: stored -> indirect", "indices: stored -> indexed",
                                                                "color: none -> color_written, discarded"));
}

TEST(Barriers, CountersAreClearedThenUpdatedStepByStepAndReadAtTheEnd) {
    Graph graph;
    Image a = graph.create("a", small_shape()), b = graph.create("b", small_shape());
    graph.clear(a, {});
    graph.enter(pass_of(Stage::rain, "rain/some"), 4);
    for (int i = 0; i < 2; ++i) graph.compute("shade_and_count.comp").samples("source", a).stores("target", b).over({64, 32});
    graph.keep(b);
    const Plan plan = compiled(graph);
    EXPECT_THAT(step_names(plan),
                ElementsAre("clear a", "clear counters of rain/some", "shade_and_count.comp", "shade_and_count.comp"));
    EXPECT_THAT(waits(plan, 2), UnorderedElementsAre("a: copied_to -> sampled", "b: none -> stored, discarded",
                                                     "counters of rain/some: copied_to -> updated"));
    EXPECT_THAT(waits(plan, 3), UnorderedElementsAre("b: stored -> stored", "counters of rain/some: updated -> updated"));
    EXPECT_THAT(final_waits(plan),
                UnorderedElementsAre("b: stored -> copied_from", "counters of rain/some: updated -> copied_from"));
}

TEST(Barriers, WhatIsKeptEndsReadableAndImportsAreLeftAsTheyWereFound) {
    Graph graph;
    Image history = graph.import("history", small_shape(), ImportId{1}), a = graph.create("a", small_shape());
    graph.compute("copy.comp").loads("source", history).stores("target", a).over({64, 32});
    graph.keep(a);
    const Plan plan = compiled(graph);
    EXPECT_THAT(waits(plan, 0), UnorderedElementsAre("history: copied_from -> loaded", "a: none -> stored, discarded"));
    EXPECT_THAT(final_waits(plan), UnorderedElementsAre("history: loaded -> copied_from", "a: stored -> copied_from"));
}

}  // namespace
}  // namespace strata
