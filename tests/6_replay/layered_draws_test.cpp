// Draws into all layers of an array at once, the layer chosen by a vertex shader or by a geometry shader.
#include <array>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "replay/scene/scene_records.h"
#include "tests/support/session.h"
#include "tests/support/test_frame.h"

namespace strata {
namespace {

constexpr const char* corners_block = R"(
    layout(set = 1, binding = 1, scalar) readonly buffer Corners { vec3 corners[]; };
)";

/// Instance i goes to layer i.
constexpr const char* layer_from_vertex = R"(
    #extension GL_ARB_shader_viewport_layer_array : require
    layout(location = 0) flat out float out_value;
    void main() {
        gl_Position = vec4(corners[gl_VertexIndex], 1);
        gl_Layer = gl_InstanceIndex;
        out_value = 0.25 * (1 + gl_InstanceIndex);
    })";

constexpr const char* value_from_vertex = R"(
    layout(location = 0) flat out float out_value;
    void main() {
        gl_Position = vec4(corners[gl_VertexIndex], 1);
        out_value = 0.25 * (1 + gl_InstanceIndex);
    })";

/// A triangle goes to the layer that its value says.
constexpr const char* layer_from_geometry = R"(
    layout(triangles) in;
    layout(triangle_strip, max_vertices = 3) out;
    layout(location = 0) flat in float in_value[];
    layout(location = 0) flat out float out_value;
    void main() {
        for (uint i = 0u; i < 3u; ++i) {
            gl_Position = gl_in[i].gl_Position;
            gl_Layer = int(in_value[i] * 4) - 1;
            out_value = in_value[i];
            EmitVertex();
        }
    })";

constexpr const char* paint_value = R"(
    layout(location = 0) flat in float value;
    layout(location = 0) out vec4 out_color;
    void main() { out_color = vec4(value); })";

struct DrawCommand {
    std::uint32_t index_count = 3, instance_count = 1, first_index = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t first_instance = 0;
};

enum class LayerFrom { vertex_shader, geometry_shader };

/// Instances 0 to 2 of a triangle over the left half, at depth .5, and three layers to draw them into.
struct LayeredFrame : TestFrame {
    explicit LayeredFrame(LayerFrom chosen) : from(chosen) {
        shader("choosing.vert", fmt::format("{}{}", corners_block, layer_from_vertex));
        shader("sorting.vert", fmt::format("{}{}", corners_block, value_from_vertex));
        shader("sorting.geom", layer_from_geometry);
        shader("choosing.frag", paint_value);
        const std::vector<glm::vec3> corners = {{-1, -1, .5}, {-1, 3, .5}, {0, -1, .5}, {0, -1, .5}, {-1, 3, .5}, {0, 3, .5}};
        const std::vector<DrawCommand> commands = {{.index_count = 6, .instance_count = 3}};
        list.commands = import_values(graph, "commands", ImportId{1}, commands);
        list.indices = import_values<std::uint32_t>(graph, "indices", ImportId{2}, {0, 1, 2, 3, 4, 5});
        list.count = 1;
        graph.offer("Corners", import_values(graph, "corners", ImportId{3}, corners));
    }
    Image slices(Format format, double cleared) {
        Image image = graph.create("slices", {.extent = {16, 8}, .format = format, .layers = 3});
        graph.clear(image, {{cleared, cleared, cleared, cleared}});
        return image;
    }
    DrawStep draw() {
        DrawStep builder = graph.draw("choosing", list);
        return from == LayerFrom::geometry_shader ? builder.geometry("sorting") : builder;
    }
    LayerFrom from;
    DrawList list;
};

class LayeredDraw : public testing::TestWithParam<LayerFrom> {};

std::string layer_source_name(const testing::TestParamInfo<LayerFrom>& tested) {
    return tested.param == LayerFrom::vertex_shader ? "ChosenByTheVertexShader" : "ChosenByTheGeometryShader";
}

INSTANTIATE_TEST_SUITE_P(Triangles, LayeredDraw, testing::Values(LayerFrom::vertex_shader, LayerFrom::geometry_shader),
                         layer_source_name);

TEST_P(LayeredDraw, PutsEachTriangleIntoItsLayerAndIntoNoOther) {
    LayeredFrame frame(GetParam());
    Image slices = frame.slices(Format::r32f, 0);
    frame.draw().covers(slices);
    const HostImage result = frame.result(slices);
    for (std::uint32_t layer = 0; layer < 3; ++layer) {
        EXPECT_EQ(texel(result, 2, 5, layer).x, .25 * (1 + layer));
        EXPECT_EQ(texel(result, 12, 5, layer).x, 0);
    }
}

TEST_P(LayeredDraw, BlendsWithWhatIsInTheLayer) {
    LayeredFrame frame(GetParam());
    Image slices = frame.slices(Format::r16_unorm, 1);
    for (int times = 0; times < 2; ++times) frame.draw().multiplies(slices);
    const HostImage result = frame.result(slices);
    for (std::uint32_t layer = 0; layer < 3; ++layer) {
        const double factor = .25 * (1 + layer);
        EXPECT_NEAR(texel(result, 2, 5, layer).x, factor * factor, 2e-5);
        EXPECT_EQ(texel(result, 12, 5, layer).x, 1);
    }
}

TEST_P(LayeredDraw, TestsTheDepthOfTheLayer) {
    LayeredFrame frame(GetParam());
    Image slices = frame.slices(Format::r32f, 0);
    Image depth = frame.graph.create("depth", {.extent = {16, 8}, .format = Format::d32f, .layers = 3});
    frame.graph.clear(depth, {{.25}});
    frame.shader("near.frag", "void main() { gl_FragDepth = 0.75; }");
    frame.graph.fullscreen("near").writes_depth(depth, {.layer = 1});
    frame.draw().covers(slices).writes_depth(depth);
    frame.graph.keep(slices);
    frame.graph.keep(depth);
    const Execution run = frame.run();
    const std::array drawn = {.25, 0., .75}, left = {.5, .75, .5};
    for (std::uint32_t layer = 0; layer < 3; ++layer) {
        EXPECT_EQ(texel(run.images.at(slices.id), 2, 5, layer).x, drawn[layer]);
        EXPECT_EQ(texel(run.images.at(depth.id), 2, 5, layer).x, left[layer]);
    }
}

TEST_P(LayeredDraw, LeavesLayersThatAnotherDrawNamedAsTheyAre) {
    LayeredFrame frame(GetParam());
    Image slices = frame.slices(Format::r32f, 0);
    frame.shader("constant.frag", "layout(location = 0) out vec4 color; void main() { color = vec4(8); }");
    frame.graph.fullscreen("constant").covers(slices, {.layer = 1});
    frame.draw().adds_to(slices);
    const HostImage result = frame.result(slices);
    EXPECT_EQ(texel(result, 2, 5, 1).x, 8.5);
    EXPECT_EQ(texel(result, 12, 5, 1).x, 8);
    EXPECT_EQ(texel(result, 12, 5, 2).x, 0);
}

}  // namespace
}  // namespace strata
