// The technique against traced shadows, maps drawn by rays: a camera looks down a floor with two plates above it.
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "passes/reference/rays.h"
#include "passes/reference/shade.h"
#include "passes/shadows/judge.h"
#include "passes/shadows/truth.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/traced_maps.h"

namespace strata::shadows {

Technique pcf();

namespace {

void add_plate(Frame& frame, glm::vec3 center, float half) {
    Mesh plate;
    for (const auto& [x, z] : {std::pair{-1.f, -1.f}, {1.f, -1.f}, {1.f, 1.f}, {-1.f, 1.f}}) {
        plate.positions.push_back(center + half * glm::vec3(x, 0, z));
        plate.normals.emplace_back(0, 1, 0);
    }
    plate.indices = {0, 1, 2, 0, 2, 3};
    frame.draws.push_back({.mesh = static_cast<std::uint32_t>(frame.meshes.size())});
    frame.meshes.push_back(plate);
}

Frame plates_over_a_floor(std::uint32_t map_size) {
    Frame frame;
    frame.view = {.origin = {0, 2.5, 0},
                  .to_view = glm::transpose(glm::dmat3({1, 0, 0}, {0, 0.9, -std::sqrt(0.19)}, {0, -std::sqrt(0.19), -0.9})),
                  .projection = perspective(1.0, 2.0, 0.1),
                  .width = 64,
                  .height = 32};
    frame.materials.emplace_back();
    frame.materials[0].double_sided = true;
    add_plate(frame, {0, 0, 0}, 60);
    add_plate(frame, {-0.7f, 1, -4}, 0.8f);
    add_plate(frame, {2, 3, -9}, 2);
    frame.sun.direction = glm::normalize(glm::vec3(0.35f, -0.85f, -0.25f));
    frame.sun.irradiance = {1, 1, 1};
    frame.sun.cascades = 2;
    frame.sun.shadow_distance = 30;
    frame.sun.shadow = {.casts = true, .map_size = map_size, .bias = 0.01f};
    frame.lights = {{.type = LightType::round_spot,
                     .position = {-3, 4, -5},
                     .direction = glm::normalize(glm::vec3(0.5f, -0.8f, 0.1f)),
                     .axis_u = glm::vec3(0, 0, 1),
                     .range = 20,
                     .outer_angle = 0.8f,
                     .shadow = {.casts = true, .map_size = map_size, .bias = 0.01f}}};
    return frame;
}

// What the device's passes before this stage would have left.
ImageSet before(const Frame& frame) {
    const RayScene scene(frame, RayMask::opaque);
    ReferenceImage depth(frame.view.width, frame.view.height), normal(frame.view.width, frame.view.height);
    for (std::uint32_t i = 0; i < depth.texels.size(); ++i) {
        const auto hit = scene.closest({0, 0, 0}, pixel_ray(frame, i % depth.width + 0.5, i / depth.width + 0.5), 0.1, 100);
        if (!hit) continue;
        depth.texels[i].x = double(float(0.1 / hit->distance));
        normal.texels[i] = glm::dvec4(frame.view.to_view * glm::dvec3(0, 1, 0), hit->distance);
    }
    return {{"shadow_maps", traced_maps(frame)}, {"depth_layers", depth}, {"surface_normal", normal}};
}

std::vector<Metric> error(std::uint32_t map_size, double kernel) {
    const Frame frame = plates_over_a_floor(map_size);
    const ImageSet images = before(frame);
    const StageInput input{frame, images};
    const Technique technique = pcf();
    Settings settings(technique.params);
    EXPECT_TRUE(settings.set("kernel", kernel));
    return shadows_judge(technique.model(input, settings), shadows_truth(input), input);
}

}  // namespace

TEST(pcf_against_rays, comes_closer_with_finer_maps) {
    const double coarse = error(128, 1)[0].value, fine = error(512, 1)[0].value;
    EXPECT_LT(fine, 0.5 * coarse);
    EXPECT_LT(fine, 0.08);
}

TEST(pcf_against_rays, errs_at_the_rims_of_shadows_alone) {
    const auto metrics = error(512, 0);
    EXPECT_LT(metrics[1].value, 1.0);  // % of samples wrongly lit
    EXPECT_LT(metrics[2].value, 1.0);
}

TEST(pcf_against_rays, pays_for_softer_rims_with_error) { EXPECT_GT(error(256, 2)[0].value, error(256, 0)[0].value); }

}  // namespace strata::shadows
