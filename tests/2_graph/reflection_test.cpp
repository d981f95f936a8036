// What shaders say about themselves, on shaders that are built in.
#include <algorithm>
#include <set>
#include <span>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/graph/shader.h"
#include "passes/shaders/scene/materials.shared.h"
#include "tests/2_graph/small_graphs.h"

namespace strata {
namespace {

std::vector<std::string> binding_names(const Shader& shader) {
    std::vector<std::string> names;
    for (const ShaderBinding& binding : shader.bindings) names.push_back(binding.name);
    return names;
}

TEST(Reflection, EveryBuiltInShaderCanBeRead) {
    for (const EmbeddedShader& embedded : embedded_shaders()) {
        const Result<Shader> shader = reflect(std::string(embedded.name), embedded.code);
        EXPECT_TRUE(shader) << shader.error().sentence;
    }
}

TEST(Reflection, OnlyWhatAShaderUsesIsBound) {
    const Shader* draw = ShaderLibrary::built_in().find("shaders/draw.vert");
    ASSERT_TRUE(draw);
    // Materials and textures are for the draws whose fragments take them from the vertex shader (hands_on_material).
    EXPECT_THAT(binding_names(*draw),
                testing::UnorderedElementsAre("View", "VertexPositions", "Draws", "Materials", "Textures", "VertexNormals",
                                              "VertexTangents", "VertexUvs", "VertexColors", "ParticleBottoms", "ParticleTops",
                                              "ParticleDepths", "ParticleUvs", "ParticleGlows"));
    for (const ShaderBinding& binding : draw->bindings) {
        EXPECT_EQ(binding.set, 1u);
        EXPECT_FALSE(binding.written) << binding.name;
    }
}

TEST(Reflection, KindsDirectionsAndGroupsAreRead) {
    const Shader* spread = ShaderLibrary::built_in().find("shaders/spread_depth.comp");
    ASSERT_TRUE(spread);
    ASSERT_THAT(binding_names(*spread), testing::ElementsAre("samples", "layers"));
    EXPECT_TRUE(spread->bindings[0].multisampled);
    EXPECT_EQ(spread->bindings[1].kind, BindingKind::storage_image);
    EXPECT_TRUE(spread->bindings[1].arrayed && spread->bindings[1].written && !spread->bindings[1].read);
    EXPECT_EQ(spread->bindings[1].format, Format::r32f);
    EXPECT_EQ(spread->group, (Extent{8, 8, 1}));
}

TEST(Reflection, IntegerImagesAndColorOutputsAreRead) {
    const Shader* gather = ShaderLibrary::built_in().find("shaders/gather_integer.frag");
    ASSERT_TRUE(gather);
    EXPECT_TRUE(gather->bindings.at(0).integer && gather->bindings.at(0).arrayed);
    EXPECT_EQ(gather->color_outputs, 1u);
}

TEST(Reflection, AShaderThatChoosesALayerIsKnown) {
    const auto chooses = [](std::string_view name) { return ShaderLibrary::built_in().find(name)->chooses_layer; };
    EXPECT_TRUE(chooses("transparency/voxel/factors/splat_multiply.vert"));
    EXPECT_TRUE(chooses("transparency/voxel/factors/choose_slice.geom"));
    EXPECT_FALSE(chooses("shaders/draw.vert"));
    EXPECT_EQ(ShaderLibrary::built_in().find("transparency/voxel/factors/choose_slice.geom")->stage, ShaderStage::geometry);
}

/// What the shader declares to use of a device, as SPIR-V numbers it.
std::set<std::uint32_t> device_features_of(std::span<const std::uint32_t> code) {
    constexpr std::uint32_t op_capability = 17, header_words = 5;
    std::set<std::uint32_t> found;
    for (std::size_t at = header_words; at + 1 < code.size() && (code[at] & 0xffffu) == op_capability; at += 2)
        found.insert(code[at + 1]);
    return found;
}

// A device runs a shader that asks for more than it has, or crashes; only the validation layer would say so.
TEST(Reflection, ShadersAskForCapabilitiesThatTheirTechniquesName) {
    constexpr std::uint32_t geometry = 2, int64 = 11, int64_atomics = 12, draw_parameters = 4427, viewport_layer = 5254;
    for (const EmbeddedShader& shader : embedded_shaders()) {
        const auto uses = device_features_of(shader.code);
        const bool is_k_buffer = shader.name.starts_with("transparency/k_buffer/");
        EXPECT_EQ(uses.contains(geometry), shader.name.ends_with(".geom")) << shader.name << ": geometry_shaders";
        EXPECT_TRUE(is_k_buffer || !(uses.contains(int64) || uses.contains(int64_atomics))) << shader.name << ": int64_atomics";
        EXPECT_FALSE(uses.contains(draw_parameters)) << shader.name << ": gl_BaseVertex, gl_DrawID";
        EXPECT_FALSE(uses.contains(viewport_layer)) << shader.name << ": gl_ViewportIndex";
    }
}

TEST(Reflection, NestedStructsAreFlattened) {
    const Shader* draw = ShaderLibrary::built_in().find("shaders/draw.vert");
    ASSERT_TRUE(draw);
    const auto row = std::ranges::find(draw->members, "materials.textures.row0", &BlockMember::name);
    ASSERT_NE(row, draw->members.end());
    EXPECT_EQ(row->block, "Materials");
    EXPECT_EQ(row->holder, "TextureUseRecord");
    EXPECT_EQ(row->offset, offsetof(MaterialRecord, textures) + offsetof(TextureUseRecord, row0));
}

TEST(Reflection, WhatIsNotSpirvIsAnErrorAndNoCrash) {
    const std::uint32_t words[] = {1, 2, 3, 4, 5, 6};
    const Result<Shader> shader = reflect("nonsense.comp", words);
    EXPECT_THAT(shader, FailsWith("shader.invalid_spirv", Field("shader", "nonsense.comp")));
}

TEST(Reflection, AShaderNobodyLooksUpIsNotReflected) {
    const ShaderLibrary library(embedded_shaders());
    EXPECT_EQ(library.reflected(), 0u);
    for (int again = 0; again < 2; ++again) EXPECT_NE(library.find("shaders/fullscreen.vert"), nullptr);
    EXPECT_EQ(library.find("shaders/nowhere.comp"), nullptr);
    EXPECT_EQ(library.reflected(), 1u);
    EXPECT_EQ(library.names().size(), embedded_shaders().size());
}

/// spread and gather against the real shaders: the plan compiles, for every kind of format.
TEST(Reflection, SamplesBecomeLayersAndComeBack) {
    for (const Format format : {Format::rgba16f, Format::r32ui, Format::rgba8_unorm}) {
        Graph graph;
        Image samples = graph.create("samples", {.extent = {64, 32}, .format = format, .samples = 4});
        graph.clear(samples, {});
        const Image layers = spread(graph, samples, "layers");
        EXPECT_EQ(graph.shape(layers), (Shape{.extent = {64, 32}, .format = format, .layers = 4}));
        const Image back = gather(graph, layers, "back");
        EXPECT_EQ(graph.shape(back), graph.shape(samples));
        graph.keep(back);
        const Result<Plan> plan = compile(graph, ShaderLibrary::built_in());
        EXPECT_TRUE(plan) << plan.error().sentence;
    }
}

TEST(Reflection, DepthBecomesLayersWhateverItsSamples) {
    for (const std::uint32_t samples : {1u, 4u}) {
        Graph graph;
        Image depth = graph.create("depth", {.extent = {64, 32}, .format = Format::d32f, .samples = samples});
        graph.clear(depth, {});
        const Image layers = spread(graph, depth, "depth layers");
        EXPECT_EQ(graph.shape(layers), (Shape{.extent = {64, 32}, .format = Format::r32f, .layers = samples}));
        graph.keep(layers);
        const Result<Plan> plan = compile(graph, ShaderLibrary::built_in());
        EXPECT_TRUE(plan) << plan.error().sentence;
    }
}

TEST(Reflection, AtOneSampleColorNeedsNeither) {
    Graph graph;
    Image color = graph.create("color", small_shape());
    EXPECT_EQ(spread(graph, color, "layers"), color);
    EXPECT_EQ(gather(graph, color, "samples"), color);
    EXPECT_TRUE(graph.steps().empty());
}

}  // namespace
}  // namespace strata
