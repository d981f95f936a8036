// Facts of the march over min-max maps: what it declares. That it changes no bit and reads less is tested on the device
// (tests/5_techniques/sun_shafts_test.cpp).
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/shadow_use.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/scene/scene_facts.h"
#include "passes/shadows/bounds/build.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::sun_shafts {

Technique ray_march_min_max();

namespace {

using testing::ElementsAre;

constexpr const char *extremes = "shadows/bounds/extremes.comp", *nodes = "shadows/bounds/nodes.comp",
                     *march = "sun_shafts/ray_march_min_max/march.comp";

struct Case {
    std::uint32_t cascades = 1;
    ShadowUse shadow = {.casts = true, .map_size = 64};
    std::optional<BoundsSettings> built = {};  ///< bounds of the shadows' technique
    std::string segment = "1", bounds = "shared";
};

/// Names of the steps that the technique declares for a frame in fog.
std::vector<std::string> steps(const Case& c) {
    const Technique technique = ray_march_min_max();
    Frame frame = one_pixel(1);
    frame.fog.density = .1f;
    frame.sun.irradiance = glm::vec3(1);
    frame.sun.shafts = true;
    frame.sun.cascades = c.cascades;
    frame.sun.shadow = c.shadow;
    const Features features = frame_features(frame);
    const SceneFacts facts(frame);
    Graph graph;
    FrameImages images;
    images.recorded = &frame;
    images.features = &features;
    images.facts = &facts;
    images.extent = {9, 5};
    images.depth_layers = graph.create("depth_layers", {.extent = images.extent, .format = Format::r32f});
    if (c.shadow.casts)
        images.shadow_maps = graph.create("shadow_maps", {.extent = {64, 64}, .format = Format::d32f, .layers = c.cascades});
    if (c.built)
        images.shadow_bounds = add_shadow_bounds(graph, images.shadow_maps, facts.shadow_views(Allocation::own), *c.built);
    const std::size_t before = graph.steps().size();
    Settings settings(technique.params);
    EXPECT_TRUE(settings.set("shaft_segment", std::string_view(c.segment)));
    EXPECT_TRUE(settings.set("shaft_bounds", std::string_view(c.bounds)));
    EXPECT_TRUE(settings.set("shaft_blur", "off"));
    technique.declare(graph, images, settings);
    std::vector<std::string> names;
    for (const Step& step : graph.steps().subspan(before))
        if (std::holds_alternative<ComputeWork>(step.work)) names.push_back(step.name);
    return names;
}

}  // namespace

TEST(RayMarchMinMax, BuildsBoundsOfEveryCascadeBeforeItMarches) {
    EXPECT_THAT(steps({}), ElementsAre(extremes, march));
    EXPECT_THAT(steps({.cascades = 3}), ElementsAre(extremes, extremes, extremes, march));
}

TEST(RayMarchMinMax, BuildsNoBoundsWhereTheSunCastsNoShadow) {
    EXPECT_THAT(steps({.cascades = 2, .shadow = {}}), ElementsAre(march));
    EXPECT_THAT(steps({.cascades = 2, .shadow = {}, .segment = "8"}), ElementsAre(march));
}

// Four texels reach one beyond their block, so blocks alone do not serve them; nor do other blocks and forms.
TEST(RayMarchMinMax, AsksTheBoundsThatTheShadowsHaveBuiltWhereTheirWindowsAreWideEnough) {
    for (const std::uint32_t reach : {1u, 2u, 4u})
        EXPECT_THAT(steps({.cascades = 2, .built = BoundsSettings{.reach = reach}}), ElementsAre(march)) << reach;
    for (const BoundsSettings& other :
         {BoundsSettings{.reach = 0}, BoundsSettings{.block = 8}, BoundsSettings{.form = BoundsForm::slabs},
          BoundsSettings{.form = BoundsForm::planes}, BoundsSettings{.form = BoundsForm::levels, .reach = 0}})
        EXPECT_THAT(steps({.built = other}), ElementsAre(extremes, march));
}

// Wider windows leave more steps to the map, which at all but small pictures costs more than bounds of its own.
TEST(RayMarchMinMax, AsksNoBoundsOfWiderWindowsUnlessToldTo) {
    EXPECT_THAT(steps({.built = BoundsSettings{.reach = 1}, .bounds = "as_narrow"}), ElementsAre(march));
    for (const std::uint32_t reach : {0u, 2u, 4u})
        EXPECT_THAT(steps({.built = BoundsSettings{.reach = reach}, .bounds = "as_narrow"}), ElementsAre(extremes, march))
            << reach;
}

TEST(RayMarchMinMax, BuildsNodesForSegmentsAloneAndNoneWiderThanAMap) {
    EXPECT_THAT(steps({.segment = "8"}), ElementsAre(extremes, nodes, nodes, nodes, nodes, march)) << "8, 16, 32 and 64 texels";
    EXPECT_THAT(steps({.shadow = {.casts = true, .map_size = 24}, .segment = "2"}), ElementsAre(extremes, nodes, nodes, march))
        << "8 and 16 texels";
    EXPECT_THAT(steps({.shadow = {.casts = true, .map_size = 7}, .segment = "2"}), ElementsAre(extremes, march));
}

}  // namespace strata::sun_shafts
