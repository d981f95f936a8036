// Facts of the wide layout: errors of docs/algorithms/deferred.md 2.3 and 2.5, and its codes of materials.
#include <gtest/gtest.h>

#include <set>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/wide/model.h"
#include "passes/gbuffer/wide/wide.shared.h"
#include "tests/support/normal_errors.h"

namespace strata::gbuffer {
namespace {

TEST(WideGBuffer, NormalsOfAnyDirectionAreOffAsTheTableSays) {
    const NormalErrors errors = errors_of_a_million_normals(wide_normal);
    EXPECT_NEAR(errors.worst, 0.0229, 0.05 * 0.0229);
    EXPECT_NEAR(errors.mean, 0.0061, 0.05 * 0.0061);
}

/// Each coordinate by itself, so that a position leaves its ray: by half a step of a half float at x, which is 2^-9 m at 5 m.
TEST(WideGBuffer, RoundsPositionsCoordinateByCoordinate) {
    const glm::dvec3 stored = wide_position({5.0013, -0.3, 10.003}, 0.1);
    EXPECT_EQ(stored.x, 5);
    EXPECT_EQ(stored.y, -half_value(half_bits(0.3)));
    EXPECT_EQ(stored.z, 10);
    EXPECT_EQ(wide_position({0, 0, -3}, 0.5).z, 0.5) << "before the near plane is the near plane";
}

/// Far from the axis of a picture of 360 rows: y = 4 m at z = 10 m steps by 2^-8 m, which is 0.14 pixel.
TEST(WideGBuffer, PlacesThatHangOnRoundingAreUndecided) {
    Frame frame;
    frame.view.width = 640;
    frame.view.height = 360;
    frame.view.near = .1f;
    frame.view.projection = glm::mat4(0);
    frame.view.projection[0][0] = 1.126f;
    frame.view.projection[1][1] = -2.002f;
    const glm::dvec2 center(320.5, 324.5);
    const double middle = 4 + 0x1p-9;
    EXPECT_TRUE(place_hangs_on_rounding(frame, center, {0, -middle, 10}));
    EXPECT_TRUE(place_hangs_on_rounding(frame, center, {0, -middle * (1 + 1e-7), 10}));
    EXPECT_FALSE(place_hangs_on_rounding(frame, center, {0, -middle * (1 + 1e-4), 10}));
    EXPECT_TRUE(place_hangs_on_rounding(frame, center, {0, -4, 10 + 0x1p-8})) << "z moves it as well";
    EXPECT_FALSE(place_hangs_on_rounding(frame, center, {4 + 0x1p-9, -4, 10})) << "x counts 1/4096 in the code of a place";
    EXPECT_FALSE(place_hangs_on_rounding(frame, {320.5, 180.5}, {0, -0x1.002p-7, 10})) << "steps are small near the axis";
}

TEST(WideGBuffer, EveryLightingModelHasCodesOfItsOwn) {
    std::set<std::uint32_t> codes;
    for (std::uint32_t model = 0; model <= static_cast<std::uint32_t>(last_lighting_model); ++model)
        for (const double metallic : {0.0, 0.5, 1.0}) {
            SurfacePoint p;
            p.model = static_cast<LightingModel>(model);
            p.metallic = metallic;
            const std::uint32_t code = wide_material_code(p);
            EXPECT_LT(code, code_count);
            EXPECT_EQ(code / wide_metallic_steps, model);
            EXPECT_TRUE(codes.insert(code).second);
        }
}

}  // namespace
}  // namespace strata::gbuffer
