// Facts of tiles as cells, and of which lights reach them (docs/algorithms/lighting.md 1.9), on the CPU's float copy of the
// shader's code.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <numbers>

#include "tests/support/random_lights.h"

namespace strata::lighting {
namespace {

const ViewRecord wide = view_of({1280, 720});

TEST(TileCell, HasTheRaysOfTheChapter) {
    const Cell<float> corner = tile_cell(wide, {0, 0}, 16, {1, 1});
    EXPECT_NEAR(corner.corners[0].x, -1.7777778, 1e-6);
    EXPECT_NEAR(corner.corners[1].x, -1.7333333, 1e-6);
    EXPECT_NEAR(corner.corners[2].y, .9555556, 1e-6);
    EXPECT_NEAR(corner.corners[0].y, 1, 1e-6);
    const Cell<float> middle = tile_cell(wide, {40, 22}, 16, {1, 1});
    EXPECT_NEAR(middle.corners[0].x, 0, 1e-6);
    EXPECT_NEAR(middle.corners[3].x, .0444444, 1e-6);
    EXPECT_NEAR(middle.corners[0].y, .0222222, 1e-6);
    EXPECT_NEAR(middle.corners[3].y, -.0222222, 1e-6);
}

TEST(TileCell, EndsWithThePicture) {
    // 1080 rows are 67.5 tiles.
    const Cell<float> last = tile_cell(view_of({1920, 1080}), {119, 67}, 16, {1, 2});
    EXPECT_NEAR(last.corners[3].x, 1920. / 1080, 1e-6);
    EXPECT_NEAR(last.corners[3].y, -1, 1e-6);
    EXPECT_NEAR(last.corners[0].y - last.corners[2].y, 8 * 2. / 1080, 1e-6);
}

TEST(TileCell, KeepsAndDropsSpheresAsTheChapterSays) {
    const Cell<float> cell = tile_cell(wide, {40, 22}, 16, {10, 20});
    EXPECT_TRUE(sphere_touches({-1, 0, 15}, 1, cell));
    EXPECT_FALSE(sphere_touches({-1, 0, 15}, .999f, cell));
    // Off a corner: all six planes keep it, the cell's box drops it at a distance of 1.0557310.
    const glm::vec3 off_corner(-.8f, 1.1333333f, 15);
    for (const glm::vec4& plane : cell.planes) EXPECT_GT(glm::dot(glm::vec3(plane), off_corner) + plane.w, -1);
    EXPECT_FALSE(sphere_touches(off_corner, 1, cell));
    EXPECT_FALSE(sphere_touches(off_corner, 1.0557f, cell));
    EXPECT_TRUE(sphere_touches(off_corner, 1.0558f, cell));
}

TEST(TileCell, KeepsAndDropsConesAsTheChapterSays) {
    const Cone cone{{0, 0, 1}, float(std::cos(std::numbers::pi / 6)), 10};
    EXPECT_FALSE(cone_touches(cone, {5, 0, 5}, 1.83f));
    EXPECT_TRUE(cone_touches(cone, {5, 0, 5}, 1.8302f));
}

TEST(TileCell, OfAJitteredViewHoldsWhatItsPixelsSee) {
    for (const glm::vec2 offset : {glm::vec2(.01f, -.02f), glm::vec2(-.3f, .25f)}) {
        const ViewRecord view = view_of({160, 90}, offset);
        for (const glm::dvec3 p : {glm::dvec3(1, 2, 10), glm::dvec3(-4, .5, 10), glm::dvec3(0, 0, 10)}) {
            const glm::dvec2 ndc = glm::dvec2(view.ndc_scale) * glm::dvec2(p) / p.z + glm::dvec2(view.ndc_offset);
            const glm::vec2 pixel((ndc.x + 1) / 2 * 160, (1 - ndc.y) / 2 * 90);
            const glm::vec3 again = view_ray(view, pixel) * 10.f;
            EXPECT_NEAR(again.x, p.x, 1e-5);
            EXPECT_NEAR(again.y, p.y, 1e-5);
            const Cell<float> cell = tile_cell(view, glm::uvec2(pixel) / 16u, 16, {9, 11});
            for (const glm::vec4& plane : cell.planes) EXPECT_GE(glm::dot(glm::vec3(plane), again) + plane.w, -1e-5);
        }
    }
}

TEST(TileCulling, NeverDropsALightThatLightsAPointOfTheCell) {
    Numbers numbers(1);
    const ViewRecord view = view_of({160, 90});
    std::array<std::size_t, 8> kept{}, all{}, lit{};
    for (int i = 0; i < 60000; ++i) {
        const LightRecord light = random_light(numbers);
        const glm::uvec2 tile(numbers.below(10), numbers.below(6));
        const float near = numbers.from(.2f, 20), far = near + numbers.from(0, 1) * numbers.from(0, 10);
        const Cell<float> cell = tile_cell(view, tile, 16, {near, far});
        const bool touches = light_touches({light, {}, cell_slack(light, cell)}, cell);
        bool any = false;
        for (int k = 0; k < (touches ? 400 : 24) && !any; ++k)
            any = may_light(light, random_point(numbers, view, tile, {near, far}));
        ASSERT_TRUE(touches || !any) << "light " << i << " of type " << light.type;
        kept[light.type] += touches, lit[light.type] += any, ++all[light.type];
    }
    for (std::size_t type = 0; type < static_cast<std::size_t>(LightType::directional); ++type) {
        EXPECT_LT(kept[type], all[type]) << type;
        // What is kept needlessly.
        EXPECT_LT(double(kept[type] - lit[type]), .4 * double(kept[type])) << type;
    }
}

TEST(TileCulling, TestsConesPyramidsAndHalfBoxesTighterThanTheirSpheres) {
    Numbers numbers(2);
    const ViewRecord view = view_of({160, 90});
    std::array<std::size_t, 8> as_sphere{}, as_itself{};
    for (int i = 0; i < 20000; ++i) {
        LightRecord light = random_light(numbers);
        const Cell<float> cell = tile_cell(view, {numbers.below(10), numbers.below(6)}, 16, {5, numbers.from(5, 8)});
        const std::uint32_t type = light.type;
        as_itself[type] += light_touches({light, {}, cell_slack(light, cell)}, cell);
        light.type = static_cast<uint>(LightType::omni);
        as_sphere[type] += light_touches({light, {}, cell_slack(light, cell)}, cell);
    }
    for (const LightType type : {LightType::round_spot, LightType::square_spot, LightType::rectangle, LightType::disc})
        EXPECT_LT(double(as_itself[std::size_t(type)]), .8 * double(as_sphere[std::size_t(type)])) << int(type);
}

TEST(TileCulling, DropsWhatAClipPlaneHidesAndTestsWhatItCuts) {
    const Cell<float> cell = tile_cell(wide, {40, 22}, 16, {10, 20});
    LightRecord light = omni({0, 0, 15}, 5);
    light.clips = 1;
    const auto reach = [&](float z) {
        const std::vector<ClipPlaneRecord> planes{{{0, 0, 1}, -z}};
        const TouchedBy by{light, planes, cell_slack(light, cell)};
        return std::pair(light_touches(by, cell), is_straddled(by, cell));
    };
    EXPECT_EQ(reach(9), std::pair(true, false));
    EXPECT_EQ(reach(15), std::pair(true, true));
    EXPECT_EQ(reach(21), std::pair(false, true));
}

}  // namespace
}  // namespace strata::lighting
