// Draws into all layers of an array at once: gl_Layer, written by a vertex or a geometry shader, says which one a triangle is in.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/graph/describe.h"
#include "passes/graph/graph.h"
#include "tests/2_graph/small_graphs.h"

namespace strata {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

Shape layered(std::uint32_t layers, Format format = Format::r8_unorm) {
    Shape shape = small_shape(format);
    shape.layers = layers;
    return shape;
}

/// Cleared slices of a volume, and triangles sorted into them by sort.geom.
struct Slices {
    Graph graph;
    Image slices = graph.create("slices", layered(4));
    DrawList list{.commands = graph.import("commands", 20, ImportId{1}), .indices = graph.import("indices", 12, ImportId{2})};

    Slices() {
        graph.offer("List", graph.import("list", 16, ImportId{3}));
        graph.clear(slices, {{1, 1, 1, 1}});
        graph.keep(slices);
    }
    DrawStep draw() { return graph.draw("paint", list).geometry("sort"); }
};

TEST(LayeredDraws, GoThroughAGeometryShaderWithTheVertexShaderBesideItOrTheScenes) {
    Slices f;
    f.draw().multiplies(f.slices);
    EXPECT_THAT(compiled(f.graph).steps[1].step.shaders, ElementsAre("shaders/draw.vert", "sort.geom", "paint.frag"));

    Slices own;
    own.graph.draw("paint", own.list).geometry("depth_only").multiplies(own.slices);
    EXPECT_THAT(refusal(own.graph), FailsWith("shader.unknown", Field("shader", "depth_only.geom")));
}

TEST(LayeredDraws, TakeWhatTheGeometryShaderDeclaresFromTheOffers) {
    Slices f;
    f.draw().multiplies(f.slices);
    const Plan plan = compiled(f.graph);
    ASSERT_EQ(plan.steps[1].bindings.size(), 1u);
    EXPECT_EQ(plan.steps[1].bindings[0].binding.name, "List");
}

TEST(LayeredDraws, HaveOneThingInOnePlaceWhicheverShaderDeclaresIt) {
    Slices f;
    Image source = f.graph.create("source", small_shape());
    f.graph.clear(source, {});
    f.graph.draw("shade", f.list).geometry("sort").samples("source", source).multiplies(f.slices);
    EXPECT_THAT(refusal(f.graph),
                FailsWith("graph.binding_place_taken", Field("binding", "source"), Field("other", "List"), Field("slot", 0)));
}

TEST(LayeredDraws, DrawIntoAsManyLayersAsTheirAttachmentsHave) {
    Slices f;
    f.draw().multiplies(f.slices);
    f.graph.fullscreen("paint").multiplies(f.slices, {.layer = 2});
    const Plan plan = compiled(f.graph);
    EXPECT_EQ(plan.steps[1].layers, 4u);
    EXPECT_EQ(plan.steps[2].layers, 1u);
}

TEST(LayeredDraws, NeedAsManyLayersOfEveryAttachment) {
    Slices f;
    Image depth = f.graph.create("depth", small_depth());
    f.graph.clear(depth, {});
    f.draw().multiplies(f.slices).tests_depth(depth);
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.attachment_layers", Field("image", "slices"), Field("layers", 4),
                                            Field("other", "depth"), Field("other_layers", 1)));

    Slices part;
    Image maps = part.graph.create("maps", layered(6, Format::d32f));
    part.graph.clear(maps, {});
    part.draw().multiplies(part.slices, {.layer = 1}).writes_depth(maps);
    EXPECT_THAT(refusal(part.graph), FailsWith("graph.attachment_layers", Field("image", "slices"), Field("layers", 1),
                                               Field("other", "maps"), Field("other_layers", 6)));
}

TEST(LayeredDraws, NeedAShaderThatChoosesTheLayer) {
    Slices f;
    f.graph.draw("paint", f.list).multiplies(f.slices);
    EXPECT_THAT(refusal(f.graph),
                FailsWith("graph.layer_not_named", Field("step", "paint"), Field("image", "slices"), Field("layers", 4)));
    Slices fullscreen;
    fullscreen.graph.fullscreen("paint").covers(fullscreen.slices);
    EXPECT_THAT(refusal(fullscreen.graph), FailsWith("graph.layer_not_named", Field("image", "slices")));
}

TEST(LayeredDraws, WaitForEveryLayerAndAreWaitedFor) {
    Slices f;
    f.graph.fullscreen("paint").multiplies(f.slices, {.layer = 2});
    f.draw().multiplies(f.slices);
    f.graph.fullscreen("paint").multiplies(f.slices, {.layer = 1});
    const Plan plan = compiled(f.graph);
    EXPECT_THAT(waits(plan, 1), ElementsAre("slices layer 2: copied_to -> color_blended"));
    EXPECT_THAT(
        waits(plan, 2),
        UnorderedElementsAre("slices layer 0: copied_to -> color_blended", "slices layer 1: copied_to -> color_blended",
                             "slices layer 2: color_blended -> color_blended", "slices layer 3: copied_to -> color_blended"));
    EXPECT_THAT(waits(plan, 3), ElementsAre("slices layer 1: color_blended -> color_blended"));
    EXPECT_THAT(final_waits(plan), ElementsAre("slices: color_blended -> copied_from"));
}

TEST(LayeredDraws, AreSaidToBeSoInThePlansText) {
    Slices f;
    f.draw().multiplies(f.slices);
    EXPECT_THAT(describe(compiled(f.graph)), HasSubstr("    paint, through sort.geom, 4 layers at once\n"));
}

}  // namespace
}  // namespace strata
