// What a step says and what its shader says must agree; the error names both and the nearest known name.
#include <gtest/gtest.h>

#include "passes/graph/graph.h"
#include "tests/2_graph/small_graphs.h"

namespace strata {
namespace {

using testing::HasSubstr;

/// One image a, and b, which copy.comp would store.
struct TwoImages {
    Graph graph;
    Image a = graph.create("a", small_shape()), b = graph.create("b", small_shape());
};

TEST(Names, AMisspelledBindingIsNamedWithItsShader) {
    TwoImages f;
    f.graph.compute("copy.comp").loads("sorce", f.a).stores("target", f.b).over({64, 32});
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.unknown_binding", Field("shader", "copy.comp"), Field("binding", "sorce"),
                                            Field("suggestion", HasSubstr("source"))));
}

TEST(Names, AMisspelledShaderIsNamedWithTheNearestOne) {
    TwoImages f;
    f.graph.compute("wirte.comp").stores("target", f.a).over({64, 32});
    EXPECT_THAT(refusal(f.graph),
                FailsWith("shader.unknown", Field("shader", "wirte.comp"), Field("suggestion", HasSubstr("write.comp"))));
}

TEST(Names, AMissingBindingIsNamed) {
    TwoImages f;
    f.graph.compute("copy.comp").stores("target", f.b).over({64, 32});
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.not_bound", Field("shader", "copy.comp"), Field("binding", "source")));
}

TEST(Names, WritingWhatIsReadonlyIsRefused) {
    TwoImages f;
    f.graph.compute("copy.comp").updates("source", f.a).stores("target", f.b).over({64, 32});
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.readonly_written", Field("shader", "copy.comp"), Field("binding", "source"),
                                            Field("access", "updates")));
}

TEST(Names, OnlyLoadingWhatIsNotReadonlyIsRefused) {
    TwoImages f;
    f.graph.compute("change.comp").loads("target", f.a).over({64, 32});
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.not_readonly", Field("shader", "change.comp"), Field("binding", "target"),
                                            Field("access", "loads")));
}

TEST(Names, OnlyStoringWhatIsNotWriteonlyIsRefused) {
    TwoImages f;
    f.graph.compute("change.comp").stores("target", f.a).over({64, 32});
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.not_writeonly", Field("shader", "change.comp"), Field("binding", "target")));
}

TEST(Names, SamplingAStorageImageIsRefused) {
    TwoImages f;
    f.graph.compute("copy.comp").samples("source", f.a).stores("target", f.b).over({64, 32});
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.binding_kind", Field("shader", "copy.comp"), Field("binding", "source"),
                                            Field("declared", "a storage image"), Field("access", "samples")));
}

TEST(Names, AnImageWhereABufferIsDeclaredIsRefused) {
    TwoImages f;
    f.graph.compute("use_list.comp").loads("List", f.a).stores("target", f.b).over({64, 32});
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.binding_kind", Field("shader", "use_list.comp"), Field("binding", "List"),
                                            Field("declared", "a buffer"), Field("bound", "an image")));
}

TEST(Names, AnIntegerImageInAFloatVariableIsRefused) {
    Graph graph;
    Image a = graph.create("a", small_shape(Format::r32ui));
    graph.compute("write.comp").stores("target", a).over({64, 32});
    EXPECT_THAT(refusal(graph), FailsWith("graph.image_type", Field("shader", "write.comp"), Field("binding", "target"),
                                          Field("declared", "not integer"), Field("image", "a"), Field("found", "is r32ui")));
}

TEST(Names, APushBlockOfAnotherSizeIsRefused) {
    TwoImages f;
    f.graph.compute("pushed.comp").stores("target", f.a).push(1.0f).over({64, 32});
    EXPECT_THAT(refusal(f.graph),
                FailsWith("graph.push_size", Field("step", "pushed.comp"), Field("declared", 8), Field("bytes", 4)));
}

TEST(Names, AnUnknownSpecializationConstantIsNamed) {
    TwoImages f;
    f.graph.compute("pushed.comp").stores("target", f.a).push(1.0).fixes("rnak", 3u).over({64, 32});
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.unknown_constant", Field("shader", "pushed.comp"), Field("constant", "rnak"),
                                            Field("suggestion", HasSubstr("rank"))));
}

TEST(Names, AFixedGroupSizeChangesHowManyGroupsThereAre) {
    TwoImages f;
    f.graph.compute("pushed.comp").stores("target", f.a).push(1.0).fixes("width", 32u).over({65, 32});
    f.graph.keep(f.a);
    EXPECT_EQ(compiled(f.graph).steps[0].groups, (Extent{3, 4, 1}));
}

TEST(Names, AComputeStepMustSayHowManyThreads) {
    TwoImages f;
    f.graph.compute("write.comp").stores("target", f.a);
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.dispatch_size", Field("step", "write.comp")));
}

TEST(Names, ColorAttachmentsMustBeAsManyAsColorOutputs) {
    TwoImages f;
    f.graph.fullscreen("paint").covers(f.a).covers(f.b);
    EXPECT_THAT(refusal(f.graph),
                FailsWith("graph.color_count", Field("shader", "paint.frag"), Field("colors", 1), Field("attachments", 2)));
}

TEST(Names, ColorsWithoutAnAttachmentAreDroppedOnlyWhereTheStepSaysSo) {
    TwoImages f;
    f.graph.fullscreen("paint").within({8, 8, 1});
    EXPECT_THAT(refusal(f.graph),
                FailsWith("graph.color_count", Field("shader", "paint.frag"), Field("colors", 1), Field("attachments", 0)));
    Graph graph;
    Image depth = graph.create("depth", small_depth());
    graph.clear(depth, {});
    graph.fullscreen("paint").writes_depth(depth).drops_other_colors();
    graph.keep(depth);
    EXPECT_EQ(step_names(compiled(graph)).size(), 2u);
}

TEST(Names, AttachmentsMustAgreeInTheirSamples) {
    Graph graph;
    Shape shape = small_depth();
    shape.samples = 4;
    Image color = graph.create("color", small_shape()), depth = graph.create("depth", shape);
    graph.fullscreen("paint").covers(color).tests_depth(depth);
    EXPECT_THAT(refusal(graph), FailsWith("graph.attachment_samples", Field("image", "color"), Field("samples", 1),
                                          Field("other", "depth"), Field("other_samples", 4)));
}

TEST(Names, ReadingBeforeAnythingWasWrittenIsRefused) {
    TwoImages f;
    f.graph.compute("copy.comp").loads("source", f.a).stores("target", f.b).over({64, 32});
    f.graph.keep(f.b);
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.read_before_write", Field("step", "copy.comp"), Field("resource", "a"),
                                            Field("access", "loaded")));
}

TEST(Names, KeepingWhatNothingWritesIsRefused) {
    TwoImages f;
    f.graph.keep(f.a);
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.never_written", Field("image", "a")));
}

TEST(Names, SamplingAndStoringTheSameTexelsAtOnceIsRefused) {
    TwoImages f;
    f.graph.compute("sample.comp").samples("source", f.a).stores("target", f.a).over({64, 32});
    EXPECT_THAT(refusal(f.graph),
                FailsWith("graph.access_conflict", Field("step", "sample.comp"), Field("image", "a"), Field("access", "sampled"),
                          Field("binding", "source"), Field("other_access", "stored"), Field("other", "target")));
}

TEST(Names, NoImageMayBeReadAndIsPlannedAsNone) {
    TwoImages f;
    f.graph.compute("sample.comp").samples("source", Image{}).stores("target", f.b).over({64, 32});
    f.graph.keep(f.b);
    const Plan plan = compiled(f.graph);
    ASSERT_EQ(plan.steps[0].bindings.size(), 2u);
    EXPECT_FALSE(plan.steps[0].bindings[0].binding.image);
    EXPECT_EQ(plan.steps[0].bindings[0].kind, BindingKind::sampled_image);
}

TEST(Names, AnOfferedBufferIsBoundWhereTheStepBindsNone) {
    TwoImages f;
    Buffer list = f.graph.import("scene list", 64, ImportId{1});
    f.graph.offer("List", list);
    f.graph.compute("use_list.comp").stores("target", f.b).over({64, 32});
    f.graph.keep(f.b);
    const Plan plan = compiled(f.graph);
    EXPECT_EQ(plan.steps[0].bindings[0].binding.buffer, list);
    EXPECT_EQ(plan.steps[0].bindings[0].binding.access, Access::loaded);
}

TEST(Names, WhatIsOfferedUnderAPrefixComesFirstForStepsThatNameIt) {
    TwoImages f;
    const Buffer list = f.graph.import("scene list", 64, ImportId{1}), own = f.graph.import("own list", 64, ImportId{2});
    f.graph.offer("Own List", own);
    f.graph.offer("List", list);
    const auto taken = [&](const std::string& prefix) {
        Graph graph = f.graph;
        Image target = f.b;
        graph.compute("use_list.comp").takes_first(prefix).stores("target", target).over({64, 32});
        graph.keep(target);
        return compiled(graph).steps[0].bindings[0].binding.buffer;
    };
    EXPECT_EQ(taken("Own"), own);
    EXPECT_EQ(taken(""), list);
    EXPECT_EQ(taken("Another"), list);
}

TEST(Names, CountersAreOfferedInsideTheirScopeOnly) {
    TwoImages f;
    f.graph.clear(f.a, {});
    f.graph.enter(pass_of(Stage::culling, "culling/first"), 4);
    f.graph.enter(pass_of(Stage::culling, "culling/second"));
    f.graph.compute("count.comp").samples("source", f.a).over({64, 32});
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.not_bound", Field("shader", "count.comp"), Field("binding", "Counters")));
}

TEST(NamesDeathTest, AStaleHandleStopsTheProgramWithItsName) {
    TwoImages f;
    const Image stale = f.a;
    f.graph.compute("write.comp").stores("target", f.a).over({64, 32});
    EXPECT_DEATH(f.graph.compute("copy.comp").loads("source", stale), "stale handle of 'a'");
}

}  // namespace
}  // namespace strata
