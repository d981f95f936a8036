// Draws and full-screen steps: vertex pulling, blending, depth, several samples, sides of triangles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "replay/scene/scene_records.h"
#include "tests/support/session.h"
#include "tests/support/test_frame.h"

namespace strata {
namespace {

using testing::ElementsAre;

/// Corners are pulled from a buffer: xyz clip position; instance i has the value i.
constexpr const char* pulling_vertex = R"(
    layout(set = 1, binding = 1, scalar) readonly buffer Corners { vec3 corners[]; };
    layout(location = 0) flat out float out_value;
    void main() { gl_Position = vec4(corners[gl_VertexIndex], 1); out_value = gl_InstanceIndex; })";

constexpr const char* value_fragment = R"(
    layout(location = 0) flat in float value;
    layout(location = 0) out vec4 out_color;
    void main() { out_color = vec4(value, gl_FragCoord.z, 0.5, 1); })";

constexpr const char* constant_fragment = R"(
    layout(push_constant) uniform Push { vec4 color; };
    layout(location = 0) out vec4 out_color;
    void main() { out_color = color; })";

struct DrawCommand {
    std::uint32_t index_count = 3, instance_count = 1, first_index = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t first_instance = 0;
};

/// Triangles that cover the left, the right and all of the target, at depths 0.25, 0.5 and 0.75. Counter-clockwise as seen.
struct Triangles {
    explicit Triangles(Graph& graph, std::vector<DrawCommand> commands) {
        const std::vector<glm::vec3> corners = {{-1, -1, 0.25}, {-1, 3, 0.25},  {0, -1, 0.25}, {0, -1, 0.25},
                                                {-1, 3, 0.25},  {0, 3, 0.25},   {-1, -1, 0.5}, {-1, 3, 0.5},
                                                {3, -1, 0.5},   {-1, -1, 0.75}, {-1, 3, 0.75}, {3, -1, 0.75}};
        list.commands = import_values(graph, "commands", ImportId{1}, commands);
        list.indices = import_values<std::uint32_t>(graph, "indices", ImportId{2}, {0, 1, 2, 3, 4, 5});
        list.count = static_cast<std::uint32_t>(commands.size());
        graph.offer("Corners", import_values(graph, "corners", ImportId{3}, corners));
    }
    DrawList list;
};

constexpr DrawCommand left_half{.index_count = 6, .first_instance = 10};
constexpr DrawCommand middle{.vertex_offset = 6, .first_instance = 20};
constexpr DrawCommand nearest{.vertex_offset = 9, .first_instance = 30};

struct RasterFrame : TestFrame {
    RasterFrame() {
        shader("pull.vert", pulling_vertex);
        shader("pull.frag", value_fragment);
        shader("constant.frag", constant_fragment);
    }
    Image target(Format format = Format::rgba32f, std::uint32_t samples = 1) {
        Image image = graph.create("target", {.extent = {16, 8}, .format = format, .samples = samples});
        graph.clear(image, {});
        return image;
    }
    Image depth_target(std::uint32_t samples = 1) {
        Image image = graph.create("depth", {.extent = {16, 8}, .format = Format::d32f, .samples = samples});
        graph.clear(image, {});
        return image;
    }
};

TEST(Raster, CoversEveryPixelFullScreen) {
    RasterFrame frame;
    Image target = frame.target();
    frame.graph.fullscreen("constant").covers(target).push(glm::vec4(1, 2, 3, 4));
    const HostImage result = frame.result(target);
    for (std::uint32_t y = 0; y < 8; ++y)
        for (std::uint32_t x = 0; x < 16; ++x) ASSERT_EQ(texel(result, x, y), glm::dvec4(1, 2, 3, 4));
}

TEST(Raster, PullsVerticesOfIndexedIndirectDraws) {
    RasterFrame frame;
    Image target = frame.target();
    const Triangles triangles(frame.graph, {middle, left_half});
    frame.graph.draw("pull", triangles.list).covers(target);
    const HostImage result = frame.result(target);
    EXPECT_EQ(texel(result, 2, 5), glm::dvec4(10, 0.25, 0.5, 1));
    EXPECT_EQ(texel(result, 12, 5), glm::dvec4(20, 0.5, 0.5, 1));
}

TEST(Raster, DrawsTheRunOfCommandsAndAsManyAsABufferSays) {
    RasterFrame frame;
    Image target = frame.target();
    Triangles triangles(frame.graph, {nearest, middle, left_half, nearest});
    triangles.list.first = 1;
    triangles.list.count = 3;
    const Buffer count = import_values<std::uint32_t>(frame.graph, "count", ImportId{4}, {7, 2});
    frame.graph.draw("pull", triangles.list).covers(target).counted(count, 4);
    const HostImage result = frame.result(target);
    EXPECT_EQ(texel(result, 2, 5).x, 10);
    EXPECT_EQ(texel(result, 12, 5).x, 20);
}

TEST(Raster, CullsBackFacesAndKeepsCounterClockwiseOnes) {
    const auto drawn = [](Cull cull) {
        RasterFrame frame;
        Image target = frame.target();
        const Triangles triangles(frame.graph, {middle});
        frame.graph.draw("pull", triangles.list).covers(target).culls(cull);
        return texel(frame.result(target), 8, 4).x > 0;
    };
    // (-1, -1) is the top left: down the left edge, then to the right is counter-clockwise as seen.
    EXPECT_TRUE(drawn(Cull::none));
    EXPECT_TRUE(drawn(Cull::back));
    EXPECT_FALSE(drawn(Cull::front));
}

TEST(Raster, KeepsTheNearerAndLeavesDepthAloneWhereItOnlyTests) {
    RasterFrame frame;
    Image target = frame.target(), depth = frame.depth_target();
    const Triangles triangles(frame.graph, {nearest, left_half, middle});
    DrawList far_ones = triangles.list, near_one = triangles.list;
    far_ones.first = 1;
    far_ones.count = 2;
    near_one.count = 1;
    frame.graph.draw("pull", far_ones).covers(target).writes_depth(depth);
    Image tested = frame.target();
    frame.graph.draw("pull", near_one).covers(tested).tests_depth(depth);
    frame.graph.draw("pull", far_ones).covers(tested).tests_depth(depth);
    frame.graph.keep(target);
    frame.graph.keep(tested);
    frame.graph.keep(depth);
    const Execution run = frame.run();
    EXPECT_EQ(texel(run.images.at(target.id), 2, 4).x, 20) << "0.5 hides 0.25";
    EXPECT_EQ(texel(run.images.at(tested.id), 2, 4).x, 20) << "nothing was written by the test, equal depth passes";
    EXPECT_EQ(texel(run.images.at(depth.id), 2, 4).x, 0.5);
}

/// Which samples an alpha takes is the device's choice; all that Vulkan says of it is tested.
TEST(Raster, CoversNoSampleByAlphaZeroAllByOneAndNeverFewerByMore) {
    RasterFrame frame;
    frame.shader("alpha.vert", pulling_vertex);
    frame.shader("alpha.frag", R"(
        layout(location = 0) out vec4 out_color;
        void main() { out_color = vec4(floor(gl_FragCoord.x) / 15); })");
    Image depth = frame.depth_target(4);
    const Triangles triangles(frame.graph, {middle});
    frame.graph.draw("alpha", triangles.list).covers_by_alpha().drops_other_colors().writes_depth(depth);
    const Image depths = spread(frame.graph, depth, "depths");
    const HostImage result = frame.result(depths);
    const auto covered = [&](std::uint32_t x) {
        int samples = 0;
        for (std::uint32_t y = 0; y < 8; ++y)
            for (std::uint32_t sample = 0; sample < 4; ++sample) samples += texel(result, x, y, sample).x > 0;
        return samples;
    };
    EXPECT_EQ(covered(0), 0);
    EXPECT_EQ(covered(15), 4 * 8);
    for (std::uint32_t x = 1; x < 16; ++x) EXPECT_GE(covered(x), covered(x - 1)) << "alpha " << x << " / 15";
    EXPECT_LT(covered(5), 4 * 8);
}

TEST(Raster, DrawsAtEqualDepthAloneWhatIsNeitherNearerNorFarther) {
    RasterFrame frame;
    Image target = frame.target(), depth = frame.depth_target();
    const Triangles triangles(frame.graph, {middle, left_half, nearest});
    DrawList first = triangles.list;
    first.count = 1;
    frame.graph.draw("pull", first).covers(target).writes_depth(depth);
    Image equal = frame.target();
    frame.graph.draw("pull", triangles.list).covers(equal).tests_depth(depth).at_equal_depth();
    const HostImage result = frame.result(equal);
    for (const std::uint32_t x : {2u, 12u}) EXPECT_EQ(texel(result, x, 4).x, 20) << "0.25 and 0.75 come later";
}

TEST(Raster, SamplesTheDepthItTests) {
    RasterFrame frame;
    frame.shader("fade.vert", pulling_vertex);
    frame.shader("fade.frag", R"(
        layout(set = 0, binding = 0) uniform sampler2D depth;
        layout(location = 0) out vec4 out_color;
        void main() { out_color = vec4(gl_FragCoord.z - texelFetch(depth, ivec2(gl_FragCoord.xy), 0).x); })");
    Image target = frame.target(), depth = frame.depth_target();
    const Triangles triangles(frame.graph, {left_half, nearest});
    DrawList back = triangles.list, front = triangles.list;
    back.count = front.count = 1;
    front.first = 1;
    frame.graph.draw("pull", back).covers(target).writes_depth(depth);
    frame.graph.draw("fade", front).covers(target).tests_depth(depth).samples("depth", depth);
    const HostImage result = frame.result(target);
    EXPECT_EQ(texel(result, 2, 4).x, 0.5);
    EXPECT_EQ(texel(result, 12, 4).x, 0.75);
}

TEST(Raster, DrawsSeveralSamplesAndSpreadsThem) {
    RasterFrame frame;
    frame.shader("each.frag", R"(
        layout(location = 0) out vec4 out_color;
        void main() { out_color = vec4(gl_SampleID, 0, 0, 1); })");
    Image target = frame.target(Format::rgba16f, 4), depth = frame.depth_target(4);
    const Triangles triangles(frame.graph, {left_half});
    frame.graph.fullscreen("each").covers(target);
    frame.graph.draw("pull", triangles.list).covers(target).writes_depth(depth);
    const Image layers = spread(frame.graph, target, "layers"), depths = spread(frame.graph, depth, "depths");
    frame.graph.keep(layers);
    frame.graph.keep(depths);
    const Execution run = frame.run();
    for (std::uint32_t sample = 0; sample < 4; ++sample) {
        EXPECT_EQ(texel(run.images.at(layers.id), 12, 4, sample).x, sample);
        EXPECT_EQ(texel(run.images.at(layers.id), 2, 4, sample).x, 10);
        EXPECT_EQ(texel(run.images.at(depths.id), 12, 4, sample).x, 0);
        EXPECT_EQ(texel(run.images.at(depths.id), 2, 4, sample).x, 0.25);
    }
}

TEST(Raster, GivesTheHostSeveralSamplesAsLayers) {
    RasterFrame frame;
    Image target = frame.target(Format::rgba16f, 4), depth = frame.depth_target(4);
    const Triangles triangles(frame.graph, {left_half});
    frame.graph.draw("pull", triangles.list).covers(target).writes_depth(depth);
    frame.graph.draw("pull", triangles.list).adds_to(target).tests_depth(depth);
    frame.graph.keep(target);
    const Execution run = frame.run({.peeks = {{2, target}, {2, depth}}});
    for (std::uint32_t sample = 0; sample < 4; ++sample) {
        EXPECT_EQ(texel(run.peeked[0], 2, 4, sample).x, 10);
        EXPECT_EQ(texel(run.peeked[1], 2, 4, sample).x, 0.25);
        EXPECT_EQ(texel(run.peeked[1], 12, 4, sample).x, 0);
        EXPECT_EQ(texel(run.images.at(target.id), 2, 4, sample).x, 20);
    }
}

TEST(Raster, BlendsByAddingAndMultiplying) {
    RasterFrame frame;
    Image sum = frame.target(), product = frame.graph.create("product", {.extent = {16, 8}, .format = Format::rgba16f});
    frame.graph.clear(product, {{1, 1, 1, 1}});
    for (int i = 0; i < 2; ++i) {
        frame.graph.fullscreen("constant").adds_to(sum).push(glm::vec4(1, 2, 3, 4));
        frame.graph.fullscreen("constant").multiplies(product).push(glm::vec4(0.5, 0.25, 1, 0.125));
    }
    frame.graph.keep(sum);
    frame.graph.keep(product);
    const Execution run = frame.run();
    EXPECT_EQ(texel(run.images.at(sum.id), 9, 3), glm::dvec4(2, 4, 6, 8));
    EXPECT_EQ(texel(run.images.at(product.id), 9, 3), glm::dvec4(0.25, 0.0625, 1, 1.0 / 64));
}

TEST(Raster, CompositesWithATransmittancePerChannel) {
    RasterFrame frame;
    frame.shader("glass.frag", R"(
        layout(location = 0, index = 0) out vec4 out_light;
        layout(location = 0, index = 1) out vec4 out_transmittance;
        void main() { out_light = vec4(1, 2, 3, 4); out_transmittance = vec4(0.5, 0.25, 0, 1); })");
    Image target = frame.graph.create("target", {.extent = {16, 8}, .format = Format::rgba32f});
    frame.graph.clear(target, {{8, 8, 8, 8}});
    frame.graph.fullscreen("glass").composites(target);
    EXPECT_EQ(texel(frame.result(target), 9, 3), glm::dvec4(5, 4, 3, 12));
}

TEST(Raster, CompositesWithOneTransmittanceAndKeepsAlpha) {
    RasterFrame frame;
    frame.shader("gray.frag", R"(
        layout(location = 0) out vec4 out_light;  // a: transmittance
        void main() { out_light = vec4(1, 2, 3, 0.25); })");
    Image target = frame.graph.create("target", {.extent = {16, 8}, .format = Format::rgba32f});
    frame.graph.clear(target, {{8, 8, 8, 7}});
    frame.graph.fullscreen("gray").composites_gray(target);
    EXPECT_EQ(texel(frame.result(target), 9, 3), glm::dvec4(3, 4, 5, 7));
}

TEST(Raster, KeepsTheCountsOfFragmentsThatLaterOnesCover) {
    RasterFrame frame;
    frame.shader("counting.vert", pulling_vertex);
    frame.shader("counting.frag", R"(
        layout(set = 0, binding = 0, scalar) buffer Count { uint count; };
        layout(location = 0) out vec4 out_color;
        void main() {
            atomicAdd(count, 1);
            out_color = vec4(1);
        })");
    Image target = frame.graph.create("target", {.extent = {1280, 720}, .format = Format::rgba8_unorm});
    frame.graph.clear(target, {});
    Buffer count = frame.graph.create("count", 4);
    frame.graph.clear(count, 0);
    // One command: llvmpipe 22.3.6 loses the fragments of earlier instances, not those of earlier commands.
    const Triangles triangles(frame.graph, {{.instance_count = 5, .vertex_offset = 9}});
    frame.graph.draw("counting", triangles.list).covers(target).updates("Count", count);
    frame.graph.keep(target);
    frame.graph.keep(count);
    EXPECT_THAT(values_of<std::uint32_t>(frame.run().buffers.at(count.id)), ElementsAre(5 * 1280 * 720));
}

TEST(Raster, NeedsNoAttachment) {
    RasterFrame frame;
    frame.shader("count_only.frag", R"(
        layout(set = 0, binding = 0, scalar) buffer Count { uint count; };
        void main() { atomicAdd(count, 1); })");
    Buffer count = frame.graph.create("count", 4);
    frame.graph.clear(count, 0);
    frame.graph.fullscreen("count_only").updates("Count", count).within({7, 3});
    frame.graph.keep(count);
    EXPECT_THAT(values_of<std::uint32_t>(frame.run().buffers.at(count.id)), ElementsAre(21));
}

TEST(Raster, DrawsIntoALayerOfAnArray) {
    RasterFrame frame;
    Image maps = frame.graph.create("maps", {.extent = {16, 8}, .format = Format::d32f, .layers = 3});
    frame.graph.clear(maps, {});
    const Triangles triangles(frame.graph, {nearest});
    frame.shader("depth_only.vert", pulling_vertex);
    frame.graph.draw("depth_only", triangles.list).writes_depth(maps, {.layer = 1}).within({8, 8});
    const HostImage result = frame.result(maps);
    EXPECT_EQ(texel(result, 3, 3, 0).x, 0);
    EXPECT_EQ(texel(result, 3, 3, 1).x, 0.75);
    EXPECT_EQ(texel(result, 12, 3, 1).x, 0);
    EXPECT_EQ(texel(result, 3, 3, 2).x, 0);
}

TEST(Raster, TwoRunsGiveEqualBits) {
    RasterFrame frame;
    Image target = frame.target(Format::rgba16f);
    const Triangles triangles(frame.graph, {left_half, middle, nearest});
    frame.graph.draw("pull", triangles.list).adds_to(target);
    const HostImage first = frame.result(target), second = frame.result(target);
    EXPECT_EQ(first.texels, second.texels);
}

}  // namespace
}  // namespace strata
