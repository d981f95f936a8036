// A plan as text, against golden text: what a reader sees, and what a change to the compiler changes.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/graph/describe.h"
#include "passes/graph/graph.h"
#include "tests/2_graph/small_graphs.h"

namespace strata {
namespace {

/// Equal to tests/2_graph/golden/<name>, or a failure that prints both and the command that accepts the new text.
void expect_golden(const std::string& name, const std::string& text) {
    const std::filesystem::path golden = std::filesystem::path(STRATA_SOURCE_DIR) / "tests/2_graph/golden" / name;
    std::ifstream file(golden, std::ios::binary);
    std::ostringstream expected;
    expected << file.rdbuf();
    if (file && expected.str() == text) return;
    const std::filesystem::path actual = std::filesystem::path(STRATA_BINARY_DIR) / "actual" / name;
    std::filesystem::create_directories(actual.parent_path());
    std::ofstream(actual, std::ios::binary) << text;
    EXPECT_EQ(text, expected.str()) << "to accept: cp " << actual << " " << golden;
    ADD_FAILURE() << (file ? "the text differs" : "there is no golden text");
}

TEST(PlanText, AScopeNamesItsTechniqueAndThePlaceWhereThatRuns) {
    Scope scope{ScopeKind::pass, Stage::shadows, Stage::occlusion, "shadows/some"};
    EXPECT_EQ(text_of(scope), "occlusion: shadows/some");
    EXPECT_TRUE(is_pass_of(scope, "shadows/some"));
    EXPECT_FALSE(is_pass_of(scope, "some"));
    scope.kind = ScopeKind::memo;
    EXPECT_EQ(text_of(scope), "memo: occlusion: shadows/some");
    EXPECT_FALSE(is_pass_of(scope, "shadows/some")) << "a copy is not the technique's work";
    EXPECT_EQ(text_of({ScopeKind::view, Stage::shadows, Stage::shadows, "shadows/some", "atlas"}), "view: shadows/some:atlas");
    EXPECT_EQ(text_of({}), "frame");
}

TEST(PlanText, SaysOfADrawThatAlphaOrEqualDepthDecidesWhatItCovers) {
    Graph graph;
    const DrawList list{graph.import("commands", 20, ImportId{1}), graph.import("indices", 12, ImportId{2}), 0, 1};
    Image color = graph.create("color", small_shape()), depth = graph.create("depth", small_depth());
    graph.clear(depth, {});
    graph.draw("paint", list).covers_by_alpha().drops_other_colors().writes_depth(depth);
    graph.draw("paint", list).covers(color).tests_depth(depth).at_equal_depth();
    graph.keep(color);
    const std::string text = describe(compiled(graph));
    EXPECT_NE(text.find("    paint, alpha to coverage\n"), std::string::npos) << text;
    EXPECT_NE(text.find("    paint, at equal depth\n"), std::string::npos) << text;
    EXPECT_NE(text.find("        depth: depth_written -> depth_tested\n"), std::string::npos) << text;
}

TEST(ImagesWritten, AreWhatAStepClearsCopiesToStoresOrDrawsIntoEachOnce) {
    Graph graph;
    const DrawList list{graph.import("commands", 20, ImportId{1}), graph.import("indices", 12, ImportId{2}), 0, 1};
    Image read = graph.create("read", small_shape()), depth = graph.create("depth", small_depth()),
          color = graph.create("color", small_shape()), chain = graph.create("chain", {.extent = {64, 32}, .mips = 2});
    graph.clear(read, {});
    graph.copy(read, color);
    graph.compute("sample.comp").samples("source", read).stores("target", chain, {.mip = 0}).stores("target", chain, {.mip = 1});
    graph.draw("shade", list).samples("source", read).tests_depth(depth).adds_to(color);
    graph.draw("paint", list).writes_depth(depth).covers(color);
    const auto written = [&](std::size_t step) {
        std::vector<std::string> names;
        for (const Image image : images_written(graph.steps()[step])) names.push_back(graph.record(image).name);
        return names;
    };
    using testing::ElementsAre;
    EXPECT_THAT(written(0), ElementsAre("read"));
    EXPECT_THAT(written(1), ElementsAre("color"));
    EXPECT_THAT(written(2), ElementsAre("chain"));
    EXPECT_THAT(written(3), ElementsAre("color"));
    EXPECT_THAT(written(4), testing::UnorderedElementsAre("depth", "color"));
}

/// Opaque draws, a lighting step, and a transparency technique with counters and a debug picture nobody asked for.
Graph small_frame() {
    Graph graph;
    const DrawList opaque{graph.import("opaque commands", 200, ImportId{1}), graph.import("indices", 1200, ImportId{2}), 0, 10};
    Image depth = graph.create("depth", small_depth()), albedo = graph.create("albedo", small_shape()),
          light = graph.create("light", small_shape()), color = graph.create("color", small_shape()),
          picture = graph.create("picture of normals", small_shape());

    graph.enter(pass_of(Stage::gbuffer, "gbuffer/plain"));
    graph.clear(depth, {});
    graph.clear(albedo, {});
    graph.draw("paint", opaque).writes_depth(depth).covers(albedo);
    graph.compute("sample.comp").samples("source", albedo).stores("target", picture).over({64, 32});

    graph.enter(pass_of(Stage::lighting, "lighting/one_sun"));
    graph.compute("sample.comp").samples("source", albedo).stores("target", light).over({64, 32});

    graph.enter(pass_of(Stage::transparency, "transparency/plain"), 8);
    graph.compute("shade_and_count.comp").samples("source", light).stores("target", color).over({64, 32});
    graph.draw("shade", opaque).samples("source", depth).tests_depth(depth).adds_to(color);
    graph.keep(color);
    return graph;
}

/// Every mip from the one before, the last one kept.
Graph mip_chain() {
    Graph graph;
    Image chain = graph.create("chain", {.extent = {64, 32}, .format = Format::r32f, .mips = 3});
    graph.enter(pass_of(Stage::culling, "culling/pyramid"));
    graph.compute("write.comp").stores("target", chain, {.mip = 0}).over({64, 32});
    for (std::uint32_t mip = 1; mip < 3; ++mip)
        graph.compute("sample.comp")
            .samples("source", chain, Filter::nearest, {.mip = mip - 1})
            .stores("target", chain, {.mip = mip})
            .over({64u >> mip, 32u >> mip});
    graph.keep(chain);
    return graph;
}

TEST(PlanText, ASmallFrameReadsTopToBottom) { expect_golden("small_frame.txt", describe(compiled(small_frame()))); }

TEST(PlanText, AMipChainNamesItsMips) { expect_golden("mip_chain.txt", describe(compiled(mip_chain()))); }

TEST(PlanText, TheSameFrameIsAGraphvizDigraph) { expect_golden("small_frame.dot", describe_dot(compiled(small_frame()))); }

}  // namespace
}  // namespace strata
