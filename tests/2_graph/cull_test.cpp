// What is kept decides what runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/graph/graph.h"
#include "tests/2_graph/small_graphs.h"

namespace strata {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Culling, AStepNobodyReadsIsLeftOutAndSaysWhy) {
    Graph graph;
    graph.enter(pass_of(Stage::gbuffer, "gbuffer/wide"));
    Image color = graph.create("color", small_shape()), normal = graph.create("surface normal", small_shape());
    graph.compute("write.comp").stores("target", color).over({64, 32});
    graph.compute("write.comp").stores("target", normal).over({64, 32});
    graph.keep(color);

    const Plan plan = compiled(graph);
    EXPECT_EQ(plan.steps.size(), 1u);
    ASSERT_EQ(plan.culled.size(), 1u);
    EXPECT_EQ(text_of(plan.culled[0].scope), "gbuffer: gbuffer/wide");
    EXPECT_EQ(plan.culled[0].name, "write.comp");
    EXPECT_EQ(plan.culled[0].reason, "nobody reads 'surface normal'");
}

TEST(Culling, EverythingThatFeedsWhatIsKeptStays) {
    Graph graph;
    Image a = graph.create("a", small_shape()), b = graph.create("b", small_shape()), c = graph.create("c", small_shape());
    graph.compute("write.comp").stores("target", a).over({64, 32});
    graph.compute("copy.comp").loads("source", a).stores("target", b).over({64, 32});
    graph.compute("sample.comp").samples("source", b).stores("target", c).over({64, 32});
    graph.keep(c);
    EXPECT_THAT(step_names(compiled(graph)), ElementsAre("write.comp", "copy.comp", "sample.comp"));
}

TEST(Culling, AChainThatEndsNowhereIsLeftOutAsAWhole) {
    Graph graph;
    Image a = graph.create("a", small_shape()), b = graph.create("b", small_shape()), kept = graph.create("kept", small_shape());
    graph.compute("write.comp").stores("target", a).over({64, 32});
    graph.compute("copy.comp").loads("source", a).stores("target", b).over({64, 32});
    graph.compute("write.comp").stores("target", kept).over({64, 32});
    graph.keep(kept);
    EXPECT_EQ(compiled(graph).culled.size(), 2u);
}

TEST(Culling, AStoreMayLeaveTexelsAloneSoTheClearBeforeItStays) {
    Graph graph;
    Image a = graph.create("a", small_shape());
    graph.clear(a, {});
    graph.compute("write.comp").stores("target", a).over({8, 8});
    graph.keep(a);
    EXPECT_THAT(step_names(compiled(graph)), ElementsAre("clear a", "write.comp"));
}

TEST(Culling, AClearMakesWhatWasBeforeUseless) {
    Graph graph;
    Image a = graph.create("a", small_shape());
    graph.compute("write.comp").stores("target", a).over({64, 32});
    graph.clear(a, {});
    graph.keep(a);
    EXPECT_THAT(step_names(compiled(graph)), ElementsAre("clear a"));
}

TEST(Culling, AFullscreenPassMakesWhatWasBeforeUselessUnlessItCoversOnlyAPart) {
    const auto steps = [](std::optional<Extent> within) {
        Graph graph;
        Image a = graph.create("a", small_shape());
        graph.clear(a, {});
        FullscreenStep builder = graph.fullscreen("paint");
        builder.covers(a);
        if (within) builder.within(*within);
        graph.keep(a);
        return compiled(graph).steps.size();
    };
    EXPECT_EQ(steps(std::nullopt), 1u);
    EXPECT_EQ(steps(Extent{8, 8}), 2u);
}

TEST(Culling, CountingKeepsNoStepAlive) {
    Graph graph;
    Image a = graph.create("a", small_shape());
    graph.clear(a, {});
    graph.enter(pass_of(Stage::transparency, "transparency/weighted"), 4);
    graph.compute("count.comp").samples("source", a).over({64, 32});
    const Plan plan = compiled(graph);
    EXPECT_THAT(plan.steps, IsEmpty());
    ASSERT_EQ(plan.culled.size(), 3u);
    EXPECT_EQ(plan.culled[1].reason, "no step counts");
    EXPECT_EQ(plan.culled[2].reason, "it writes nothing but counters");
    EXPECT_THAT(plan.uncounted_scopes, ElementsAre(plan.scopes.size() - 1));
}

TEST(Culling, AnImportOutlivesTheFrameSoWritingItIsNeverUseless) {
    Graph graph;
    Image history = graph.import("history", small_shape(), ImportId{7});
    graph.compute("write.comp").stores("target", history).over({64, 32});
    EXPECT_EQ(compiled(graph).steps.size(), 1u);
}

TEST(Culling, ADroppedScopesOutputsMayComeFromACopy) {
    Graph graph;
    Image a = graph.create("a", small_shape()), b = graph.create("b", small_shape());
    graph.enter(pass_of(Stage::lighting, "lighting/slow"));
    graph.compute("write.comp").stores("target", a).over({64, 32});
    graph.drop_scope(1);
    graph.copy(graph.import("memo of a", small_shape(), ImportId{1}), a);
    graph.enter(pass_of(Stage::combine, "combine/quick"));
    graph.compute("copy.comp").loads("source", a).stores("target", b).over({64, 32});
    graph.keep(b);
    EXPECT_THAT(step_names(compiled(graph)), ElementsAre("copy memo of a to a", "copy.comp"));
}

}  // namespace
}  // namespace strata
