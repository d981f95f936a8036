// Facts of the octahedral layout: its codes survive half-float channels, and its errors are those of
// docs/algorithms/deferred.md 2.5.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/octahedral/model.h"
#include "tests/support/normal_errors.h"

namespace strata::gbuffer {
namespace {

glm::dvec3 octahedral_stored(const glm::dvec3& n) { return octahedral_normal(octahedral_codes(n)); }

TEST(OctahedralGBuffer, EveryCodeIsANormalHalfFloatAndComesBack) {
    for (std::uint32_t code = 0; code < code_count; ++code) {
        const std::uint16_t bits = half_of_code(code);
        const std::uint32_t exponent = (bits >> 10) & 31u;
        ASSERT_TRUE(exponent >= 1 && exponent <= 30) << "code " << code;
        ASSERT_EQ(code_of_half(bits), code);
        ASSERT_EQ(half_bits(half_value(bits)), bits) << "the value is exact, so no rounding mode can change it";
    }
}

TEST(OctahedralGBuffer, CodesOfTenBitOcclusionAreTheOnesOfTheChapter) {
    const auto code = [](std::uint32_t material, std::uint32_t occlusion) { return half_of_code(material * 1024 + occlusion); };
    EXPECT_EQ(code(0, 0), 0x0400);
    EXPECT_EQ(half_value(code(0, 0)), 6.103515625e-05);
    EXPECT_EQ(code(14, 512), 0x3e00);
    EXPECT_EQ(half_value(code(14, 512)), 1.5);
    EXPECT_EQ(code(29, 1023), 0x7bff);
    EXPECT_EQ(half_value(code(29, 1023)), 65504);
    EXPECT_EQ(code(30, 0), 0x8400);
    EXPECT_EQ(code(59, 1023), 0xfbff);
    EXPECT_EQ(half_value(code(59, 1023)), -65504);
}

TEST(OctahedralGBuffer, AllMaterialNumbersAndOcclusionsComeBack) {
    std::set<std::uint32_t> codes;
    for (std::uint32_t model = 0; model <= static_cast<std::uint32_t>(last_lighting_model); ++model)
        for (std::uint32_t metallic = 0; metallic < (has_metals(LightingModel(model)) ? 58u : 1u); ++metallic)
            for (std::uint32_t occlusion = 0; occlusion < 256; ++occlusion) {
                SurfacePoint p;
                p.model = static_cast<LightingModel>(model);
                p.metallic = metallic / 57.0;
                p.occlusion = occlusion / 255.0;
                ASSERT_LT(material_code(p), code_count);
                ASSERT_TRUE(codes.insert(material_code(p)).second) << "no two materials have one code";
                const SurfacePoint stored = stored_material(p);
                ASSERT_EQ(stored.model, p.model);
                ASSERT_DOUBLE_EQ(stored.metallic, p.metallic);
                ASSERT_DOUBLE_EQ(stored.occlusion, p.occlusion);
            }
    EXPECT_EQ(codes.size(), (4u * 58u + 5u) * 256u);
}

TEST(OctahedralGBuffer, AxesAreExact) {
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
        for (const double sign : {1.0, -1.0}) EXPECT_EQ(octahedral_stored(axis * sign), axis * sign);
}

TEST(OctahedralGBuffer, NothingTearsWhereTheLowerHalfIsFolded) {
    for (int i = 0; i < 1000; ++i) {
        const double around = 2 * std::numbers::pi * i / 1000;
        const glm::dvec3 above(std::cos(around), std::sin(around), 1e-9), below(above.x, above.y, -1e-9);
        EXPECT_LT(degrees_between(octahedral_stored(above), octahedral_stored(below)), 0.008);
    }
}

TEST(OctahedralGBuffer, AMillionNormalsAreOffAsTheTableSays) {
    const NormalErrors errors = errors_of_a_million_normals(octahedral_stored);
    EXPECT_NEAR(errors.worst, 0.0040, 0.05 * 0.0040);
    EXPECT_NEAR(errors.mean, 0.0014, 0.05 * 0.0014);
}

TEST(OctahedralGBuffer, DepthIsOffByHalfALogarithmicStep) {
    const double near = 0.1, step = std::log(1e5) / 61439;
    double worst = 0;
    for (double z = near; z < near * 1e5; z *= 1.00001) {
        const double stored = octahedral_depth(octahedral_depth_code(z, near), near);
        worst = std::max(worst, std::abs(stored - z) / z);
    }
    EXPECT_NEAR(step, 1.874e-4, 1e-7);
    EXPECT_NEAR(worst, step / 2, 0.01 * step);
}

TEST(OctahedralGBuffer, DepthsOutsideItsRangeTakeTheFirstAndTheLastCode) {
    EXPECT_EQ(octahedral_depth_code(0.1, 0.1), 0u);
    EXPECT_EQ(octahedral_depth_code(-3, 0.1), 0u) << "extrapolated to a pixel center behind the eye";
    EXPECT_EQ(octahedral_depth_code(1e9, 0.1), 61439u);
    EXPECT_EQ(octahedral_depth_code(std::numeric_limits<double>::infinity(), 0.1), 61439u);
}

}  // namespace
}  // namespace strata::gbuffer
