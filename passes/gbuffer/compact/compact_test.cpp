// Facts of the compact layout: the errors of normals of docs/algorithms/deferred.md 2.5, and what is left of materials.
#include <gtest/gtest.h>

#include "passes/gbuffer/compact/model.h"
#include "tests/support/normal_errors.h"

namespace strata::gbuffer {
namespace {

TEST(CompactGBuffer, AMillionNormalsAreOffAsTheTableSays) {
    const NormalErrors errors = errors_of_a_million_normals(compact_normal);
    EXPECT_NEAR(errors.worst, .2365, .05 * .2365);
    EXPECT_NEAR(errors.mean, .0837, .05 * .0837);
}

TEST(CompactGBuffer, TwoBitsTellUnlitHairMetalsAndTheRest) {
    for (std::uint32_t model = 0; model <= static_cast<std::uint32_t>(last_lighting_model); ++model)
        for (const double metallic : {0.0, 0.3, 0.5, 1.0}) {
            SurfacePoint p;
            p.model = static_cast<LightingModel>(model);
            p.metallic = has_metals(p.model) ? metallic : 0;
            const SurfacePoint stored = compact_material(p);
            const bool keeps_model = p.model == LightingModel::unlit || p.model == LightingModel::hair;
            EXPECT_EQ(stored.model, keeps_model ? p.model : LightingModel::ggx);
            EXPECT_EQ(stored.metallic, p.metallic >= .5 ? 1 : 0);
        }
}

TEST(CompactGBuffer, OcclusionHasTenBits) {
    SurfacePoint p;
    for (int i = 0; i <= 1023; ++i) {
        p.occlusion = i / 1023.0;
        ASSERT_DOUBLE_EQ(compact_material(p).occlusion, p.occlusion);
    }
    p.occlusion = 1.5;
    EXPECT_EQ(compact_material(p).occlusion, 1) << "out of range";
}

}  // namespace
}  // namespace strata::gbuffer
