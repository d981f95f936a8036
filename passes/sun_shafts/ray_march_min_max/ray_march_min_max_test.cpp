// Facts of the march over min-max maps: what it declares. That it changes no bit and reads less is tested on the device
// (tests/5_techniques/sun_shafts_test.cpp).
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/scene/scene_facts.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::sun_shafts {

Technique ray_march_min_max();

namespace {

using testing::ElementsAre;

/// Names of the steps that a frame in fog declares, whose sun has `cascades` maps of 64 texels.
std::vector<std::string> steps(std::uint32_t cascades, ShadowUse shadow = {.casts = true, .map_size = 64}) {
    const Technique technique = ray_march_min_max();
    Frame frame = one_pixel(1);
    frame.fog.density = .1f;
    frame.sun.irradiance = glm::vec3(1);
    frame.sun.shafts = true;
    frame.sun.cascades = cascades;
    frame.sun.shadow = shadow;
    const Features features = frame_features(frame);
    const SceneFacts facts(frame);
    Graph graph;
    FrameImages images;
    images.recorded = &frame;
    images.features = &features;
    images.facts = &facts;
    images.extent = {9, 5};
    images.depth_layers = graph.create("depth_layers", {.extent = images.extent, .format = Format::r32f});
    if (shadow.casts)
        images.shadow_maps = graph.create("shadow_maps", {.extent = {64, 64}, .format = Format::d32f, .layers = cascades});
    technique.declare(graph, images, Settings(technique.params));
    std::vector<std::string> names;
    for (const Step& step : graph.steps())
        if (std::holds_alternative<ComputeWork>(step.work)) names.push_back(step.name);
    return names;
}

}  // namespace

TEST(RayMarchMinMax, BuildsBoundsOfEveryCascadeBeforeItMarches) {
    const std::string extremes = "shadows/bounds/extremes.comp", march = "sun_shafts/ray_march_min_max/march.comp";
    EXPECT_THAT(steps(1), ElementsAre(extremes, march));
    EXPECT_THAT(steps(3), ElementsAre(extremes, extremes, extremes, march));
}

TEST(RayMarchMinMax, BuildsNoBoundsWhereTheSunCastsNoShadow) {
    EXPECT_THAT(steps(2, {}), ElementsAre("sun_shafts/ray_march_min_max/march.comp"));
}

}  // namespace strata::sun_shafts
