// What a step says and what its shader says must agree; the sentence names both and the nearest known name.
#include <gtest/gtest.h>

#include "tests/2_graph/small_graphs.h"

namespace strata {
namespace {

/// One image a, and b, which copy.comp would store.
struct TwoImages {
    Graph graph;
    Image a = graph.create("a", small_shape()), b = graph.create("b", small_shape());
};

TEST(Names, AMisspelledBindingIsNamedWithItsShader) {
    TwoImages f;
    f.graph.compute("copy.comp").loads("sorce", f.a).stores("target", f.b).over({64, 32});
    EXPECT_EQ(refusal(f.graph), "copy.comp uses no 'sorce'; did you mean source?");
}

TEST(Names, AMisspelledShaderIsNamedWithTheNearestOne) {
    TwoImages f;
    f.graph.compute("wirte.comp").stores("target", f.a).over({64, 32});
    EXPECT_EQ(refusal(f.graph), "no shader wirte.comp; did you mean write.comp?");
}

TEST(Names, AMissingBindingIsNamed) {
    TwoImages f;
    f.graph.compute("copy.comp").stores("target", f.b).over({64, 32});
    EXPECT_EQ(refusal(f.graph), "copy.comp declares 'source', and the step binds nothing to it");
}

TEST(Names, WritingWhatIsReadonlyIsRefused) {
    TwoImages f;
    f.graph.compute("copy.comp").updates("source", f.a).stores("target", f.b).over({64, 32});
    EXPECT_EQ(refusal(f.graph), "copy.comp: 'source' is readonly, but the step updates it");
}

TEST(Names, OnlyLoadingWhatIsNotReadonlyIsRefused) {
    TwoImages f;
    f.graph.compute("change.comp").loads("target", f.a).over({64, 32});
    EXPECT_EQ(refusal(f.graph), "change.comp: 'target' is not readonly, but the step only loads it");
}

TEST(Names, OnlyStoringWhatIsNotWriteonlyIsRefused) {
    TwoImages f;
    f.graph.compute("change.comp").stores("target", f.a).over({64, 32});
    EXPECT_EQ(refusal(f.graph), "change.comp: 'target' is not writeonly, but the step only stores it");
}

TEST(Names, SamplingAStorageImageIsRefused) {
    TwoImages f;
    f.graph.compute("copy.comp").samples("source", f.a).stores("target", f.b).over({64, 32});
    EXPECT_EQ(refusal(f.graph), "copy.comp: 'source' is a storage image, but the step samples an image");
}

TEST(Names, AnImageWhereABufferIsDeclaredIsRefused) {
    TwoImages f;
    f.graph.compute("use_list.comp").loads("List", f.a).stores("target", f.b).over({64, 32});
    EXPECT_EQ(refusal(f.graph), "use_list.comp: 'List' is a buffer, but the step loads an image");
}

TEST(Names, AnIntegerImageInAFloatVariableIsRefused) {
    Graph graph;
    Image a = graph.create("a", small_shape(Format::r32ui));
    graph.compute("write.comp").stores("target", a).over({64, 32});
    EXPECT_EQ(refusal(graph), "write.comp: 'target' is not integer, but image 'a' r32ui");
}

TEST(Names, APushBlockOfAnotherSizeIsRefused) {
    TwoImages f;
    f.graph.compute("pushed.comp").stores("target", f.a).push(1.0f).over({64, 32});
    EXPECT_EQ(refusal(f.graph), "pushed.comp declares 8 bytes of push constants, but the step pushes 4");
}

TEST(Names, AnUnknownSpecializationConstantIsNamed) {
    TwoImages f;
    f.graph.compute("pushed.comp").stores("target", f.a).push(1.0).fixes("rnak", 3u).over({64, 32});
    EXPECT_EQ(refusal(f.graph), "pushed.comp has no specialization constant 'rnak'; did you mean rank?");
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
    EXPECT_EQ(refusal(f.graph), "write.comp must say exactly one of .over(), .groups() and .indirect()");
}

TEST(Names, ColorAttachmentsMustBeAsManyAsColorOutputs) {
    TwoImages f;
    f.graph.fullscreen("paint").covers(f.a).covers(f.b);
    EXPECT_EQ(refusal(f.graph), "paint.frag writes 1 colors, but the step has 2 color attachments");
}

TEST(Names, ColorsWithoutAnAttachmentAreDroppedOnlyWhereTheStepSaysSo) {
    TwoImages f;
    f.graph.fullscreen("paint").within({8, 8, 1});
    EXPECT_EQ(refusal(f.graph), "paint.frag writes 1 colors, but the step has 0 color attachments");
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
    EXPECT_EQ(refusal(graph), "paint draws into 'color' with 1 samples and into 'depth' with 4");
}

TEST(Names, ReadingBeforeAnythingWasWrittenIsRefused) {
    TwoImages f;
    f.graph.compute("copy.comp").loads("source", f.a).stores("target", f.b).over({64, 32});
    f.graph.keep(f.b);
    EXPECT_EQ(refusal(f.graph), "copy.comp reads 'a' (loaded) before any step wrote or cleared it");
}

TEST(Names, KeepingWhatNothingWritesIsRefused) {
    TwoImages f;
    f.graph.keep(f.a);
    EXPECT_EQ(refusal(f.graph), "nothing writes 'a', which is kept");
}

TEST(Names, SamplingAndStoringTheSameTexelsAtOnceIsRefused) {
    TwoImages f;
    f.graph.compute("sample.comp").samples("source", f.a).stores("target", f.a).over({64, 32});
    EXPECT_EQ(refusal(f.graph), "sample.comp uses 'a' as sampled ('source') and as stored ('target') at once");
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

TEST(Names, CountersAreOfferedInsideTheirScopeOnly) {
    TwoImages f;
    f.graph.clear(f.a, {});
    f.graph.enter(act_of(Stage::culling, "culling/first"), 4);
    f.graph.enter(act_of(Stage::culling, "culling/second"));
    f.graph.compute("count.comp").samples("source", f.a).over({64, 32});
    EXPECT_EQ(refusal(f.graph), "count.comp declares 'Counters', and the step binds nothing to it");
}

TEST(NamesDeathTest, AStaleHandleStopsTheProgramWithItsName) {
    TwoImages f;
    const Image stale = f.a;
    f.graph.compute("write.comp").stores("target", f.a).over({64, 32});
    EXPECT_DEATH(f.graph.compute("copy.comp").loads("source", stale), "stale handle of 'a'");
}

}  // namespace
}  // namespace strata
