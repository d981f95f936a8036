// A frame written as glTF and read back is the same frame within float rounding, and what glTF cannot say is named.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/export/gltf.h"
#include "capture_format/export/gltf_glass.h"
#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/frame/texture.h"
#include "capture_format/import/gltf.h"
#include "capture_format/view.h"
#include "captures/scenarios.h"
#include "tests/1_capture/sample_frames.h"

namespace strata {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// What a double's way through the file's floats and the importer's arithmetic rounds off, relative to 1.
constexpr double rounding = 2e-6;

ExportedScene exported(const Frame& frame) {
    auto scene = to_gltf(frame);
    if (!scene) throw std::runtime_error(scene.error().sentence);
    return *std::move(scene);
}

Frame read_back(const Frame& frame) {
    const ExportedScene written = exported(frame);
    auto scene = GltfScene::open(written.glb, "exported.glb", {.width = frame.view.width, .height = frame.view.height});
    if (!scene) throw std::runtime_error(scene.error().sentence);
    auto read = scene->frame(0);
    if (!read) throw std::runtime_error(read.error().sentence);
    return *std::move(read);
}

template <typename Vector>
double largest_difference(const Vector& a, const Vector& b) {
    double most = 0;
    for (int i = 0; i < Vector::length(); ++i)
        most = std::max(most, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
    return most;
}

template <typename Vector>
void expect_near(const std::vector<Vector>& a, const std::vector<Vector>& b, const std::string& where) {
    ASSERT_EQ(a.size(), b.size()) << where;
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, largest_difference(a[i], b[i]));
    EXPECT_LE(most, rounding) << where;
}

void expect_equal_meshes(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(a.positions, b.positions) << a.name;
    EXPECT_EQ(a.indices, b.indices) << a.name;
    EXPECT_EQ(a.uv0, b.uv0) << a.name;
    EXPECT_EQ(a.uv1, b.uv1) << a.name;
    EXPECT_EQ(a.colors.size(), b.colors.size()) << a.name;
    expect_near(a.normals, b.normals, a.name + " normals");
    if (!a.tangents.empty()) expect_near(a.tangents, b.tangents, a.name + " tangents");
}

/// Alpha is what an opaque material does not read.
void expect_equal_textures(const Frame& a, const TextureUse& used, const Frame& b, const TextureUse& read) {
    ASSERT_EQ(used.texture == no_index, read.texture == no_index);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(used.transform[i], read.transform[i], rounding);
    if (used.texture == no_index) return;
    const Texture &wanted = a.textures[used.texture], &got = b.textures[read.texture];
    EXPECT_EQ(used.uv_set, read.uv_set);
    EXPECT_EQ(wanted.format, got.format) << wanted.name;
    EXPECT_EQ(wanted.address, got.address);
    EXPECT_EQ(wanted.magnify, got.magnify) << wanted.name;
    EXPECT_EQ(wanted.minify, got.minify) << wanted.name;
    EXPECT_EQ(wanted.between_mips, got.between_mips) << wanted.name;
    ASSERT_EQ(wanted.texels.size(), got.texels.size());
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        if (i % 4 == 3 && got.texels[i] == std::byte{255}) continue;
        ASSERT_EQ(wanted.texels[i], got.texels[i]) << wanted.name << " byte " << i;
    }
}

void expect_equal_materials(const Frame& a, const Material& wanted, const Frame& b, const Material& got) {
    SCOPED_TRACE(wanted.name);
    const bool covers = wanted.alpha_mode != AlphaMode::opaque;
    EXPECT_EQ(wanted.double_sided, got.double_sided);
    EXPECT_EQ(covers, got.alpha_mode != AlphaMode::opaque);
    EXPECT_LE(largest_difference(glm::vec3(wanted.base_color), glm::vec3(got.base_color)), rounding);
    if (covers) {
        EXPECT_NEAR(wanted.base_color.w, got.base_color.w, rounding);
    }
    EXPECT_EQ(wanted.metallic, got.metallic);
    EXPECT_EQ(wanted.roughness, got.roughness);
    EXPECT_LE(largest_difference(wanted.emissive, got.emissive), rounding * std::max(1.0f, wanted.emissive.x));
    EXPECT_LE(largest_difference(wanted.transmission, got.transmission), rounding);
    if (wanted.alpha_mode == AlphaMode::mask) {
        EXPECT_EQ(wanted.mask_cutoff, got.mask_cutoff);
    }
    EXPECT_EQ(wanted.lighting_model == LightingModel::unlit, got.lighting_model == LightingModel::unlit);
    if (wanted.normal_texture.texture != no_index) {
        EXPECT_EQ(wanted.normal_scale, got.normal_scale);
    }
    expect_equal_textures(a, wanted.base_color_texture, b, got.base_color_texture);
    expect_equal_textures(a, wanted.metallic_roughness_texture, b, got.metallic_roughness_texture);
    expect_equal_textures(a, wanted.normal_texture, b, got.normal_texture);
    expect_equal_textures(a, wanted.emissive_texture, b, got.emissive_texture);
    expect_equal_textures(a, wanted.occlusion_texture, b, got.occlusion_texture);
}

void expect_equal_views(const View& wanted, const View& got) {
    EXPECT_EQ(wanted.origin, got.origin);
    EXPECT_EQ(wanted.near, got.near);
    for (int i = 0; i < 3; ++i) EXPECT_LE(largest_difference(wanted.to_view[i], got.to_view[i]), rounding);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(wanted.projection[i][i], got.projection[i][i], 4 * rounding);
}

class ExportGltf : public testing::TestWithParam<Scenario> {};

TEST_P(ExportGltf, ReadBackIsTheSameFrame) {
    const Frame wanted = GetParam().build(0, {.width = GetParam().width, .height = GetParam().height});
    const Frame got = read_back(wanted);
    ASSERT_EQ(wanted.draws.size(), got.draws.size());
    for (std::size_t i = 0; i < wanted.draws.size(); ++i) {
        const Draw &a = wanted.draws[i], &b = got.draws[i];
        SCOPED_TRACE(a.name);
        EXPECT_EQ(a.to_world, b.to_world) << "doubles survive as text";
        expect_equal_meshes(wanted.meshes[a.mesh], got.meshes[b.mesh]);
        expect_equal_materials(wanted, wanted.materials[a.material], got, got.materials[b.material]);
    }
    expect_equal_views(wanted.view, got.view);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, ExportGltf, testing::ValuesIn(scenarios().begin(), scenarios().end()),
                         [](const auto& scenario) { return std::string(scenario.param.name); });

TEST(ExportGltf, PunctualLightsComeBack) {
    Frame frame = triangle_frame();
    frame.sun = {.direction = glm::normalize(glm::vec3(1, -2, 0.5f)), .irradiance = {2, 1, 0.5f}};
    frame.lights = {Light{.name = "lamp", .position = {1, 2, 3}, .intensity = {8, 4, 0}, .range = 7},
                    Light{.name = "spot",
                          .type = LightType::round_spot,
                          .position = {-1e6, 0.25, 3},
                          .direction = glm::normalize(glm::vec3(0, -1, 0.1f)),
                          .intensity = {1, 2, 3},
                          .inner_angle = 0.2f,
                          .outer_angle = 0.3f}};
    const Frame got = read_back(frame);
    EXPECT_LE(largest_difference(frame.sun.direction, got.sun.direction), rounding);
    EXPECT_LE(largest_difference(frame.sun.irradiance, got.sun.irradiance), rounding);
    ASSERT_EQ(got.lights.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const Light &a = frame.lights[i], &b = got.lights[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.type, b.type);
        EXPECT_EQ(a.position, b.position);
        EXPECT_EQ(a.range, b.range);
        EXPECT_LE(largest_difference(a.intensity, b.intensity), 8 * rounding);
    }
    EXPECT_LE(largest_difference(frame.lights[1].direction, got.lights[1].direction), rounding);
    EXPECT_EQ(frame.lights[1].inner_angle, got.lights[1].inner_angle);
    EXPECT_EQ(frame.lights[1].outer_angle, got.lights[1].outer_angle);
}

TEST(ExportGltf, FiltersComeBack) {
    using enum MipFilter;
    Frame frame = triangle_frame();
    frame.meshes[0].uv0 = {{0, 0}, {1, 0}, {0, 1}};
    frame.textures = {{.name = "checker", .width = 2, .height = 2, .texels = std::vector<std::byte>(16)}};
    frame.materials[0].base_color_texture.texture = 0;
    for (const TexelFilter magnify : {TexelFilter::linear, TexelFilter::nearest})
        for (const TexelFilter minify : {TexelFilter::linear, TexelFilter::nearest})
            for (const MipFilter between_mips : {linear, nearest, none}) {
                Texture& wanted = frame.textures[0];
                wanted.magnify = magnify;
                wanted.minify = minify;
                wanted.between_mips = between_mips;
                const Texture got = read_back(frame).textures.at(0);
                EXPECT_EQ(got.magnify, magnify);
                EXPECT_EQ(got.minify, minify);
                EXPECT_EQ(got.between_mips, between_mips);
            }
}

TEST(ExportGltf, AWindowThatGltfDoesNotHaveIsNamed) {
    Frame frame = triangle_frame();
    frame.lights = {Light{.name = "lamp"}};
    EXPECT_THAT(exported(frame).warnings, Contains(HasSubstr("readers of glTF end them by 1 - x^4 (1)")));
    frame.lights[0].window = RangeWindow::quartic;
    EXPECT_THAT(exported(frame).warnings, IsEmpty());
}

TEST(ExportGltf, GlassThatKeepsEnergyCanBeSaid) {
    // k + b <= 1 in every channel, and one share of the light that goes through for all of them
    for (const auto& [b, k] : {std::pair(glm::dvec3(0), glm::dvec3(1)), std::pair(glm::dvec3(0), glm::dvec3(0.96, 0.5, 0.1)),
                               std::pair(glm::dvec3(0.2), glm::dvec3(0.7, 0.3, 0.1)),
                               std::pair(glm::dvec3(0.1, 0.2, 0.3), glm::dvec3(0.1, 0.2, 0.3))}) {
        const auto glass = to_gltf_parts::glass_of({.reflected = b, .transmitted = k});
        EXPECT_TRUE(glass.is_exact);
        const double passes = 1 - std::pow((glass.ior - 1) / (glass.ior + 1), 2);
        EXPECT_LE(largest_difference(glass.color * (1 - glass.share), b), 1e-12);
        EXPECT_LE(largest_difference(glass.color * glass.share * passes * glass.attenuation, k), 1e-12);
        EXPECT_LE(std::max({glass.color.x, glass.color.y, glass.color.z}), 1);
    }
    EXPECT_FALSE(to_gltf_parts::glass_of({.reflected = {0.9, 0, 0}, .transmitted = {0, 0.9, 0}}).is_exact);
}

TEST(ExportGltf, WhatGltfCannotSayIsNamed) {
    const std::vector<std::string> warnings = exported(rich_frame()).warnings;
    for (const char* lost :
         {"draws are on another layer", "emitters of particles", "blockers", "portals", "light volumes", "fog", "rain", "lens",
          "film", "background", "sky", "jitter", "distort", "sort priority", "areas", "techniques", "not finite"}) {
        EXPECT_THAT(warnings, Contains(HasSubstr(lost)));
    }
    EXPECT_THAT(exported(triangle_frame()).warnings, IsEmpty());
}

TEST(ExportGltf, AFileIsWrittenWholeOrNotAtAll) {
    EXPECT_FALSE(export_gltf(triangle_frame(), "/nowhere/at/all.glb"));
    const auto path = std::filesystem::path(testing::TempDir()) / "strata_export.glb";
    ASSERT_TRUE(export_gltf(triangle_frame(), path));
    EXPECT_TRUE(import_gltf(path, {}));
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace strata
