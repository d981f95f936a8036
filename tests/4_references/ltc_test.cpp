// The table of linearly transformed cosines against the lobe it stands for (docs/algorithms/lighting.md 0.4, T0.7).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "passes/reference/lights.h"
#include "passes/reference/ltc_table.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {
namespace {

using std::numbers::pi;

glm::dmat3 matrix(const Ltc& ltc) {
    return {glm::dvec3(ltc.m11, 0, ltc.m31), glm::dvec3(0, ltc.m22, 0), glm::dvec3(ltc.m13, 0, ltc.m33)};
}

TEST(LtcTable, HoldsTheAlbedosOfT07) {
    const std::array<double, 4> cosines = {1, 0.7, 0.4, 0.1};
    const std::array<std::pair<double, std::array<double, 4>>, 4> rows = {{{0.1, {.98832, .98143, .95690, .88345}},
                                                                           {0.25, {.91581, .88534, .84427, .89162}},
                                                                           {0.5, {.68785, .68295, .71636, .86011}},
                                                                           {1, {1 - std::numbers::ln2, .37889, .49889, .76021}}}};
    for (const auto& [alpha, expected] : rows)
        for (std::size_t i = 0; i < 4; ++i) {
            // Between the columns of the most oblique eyes the albedo bends.
            const double tolerance = cosines[i] > 0.3 ? 1e-3 : 8e-3;
            EXPECT_NEAR(ltc_at(std::sqrt(alpha), cosines[i]).albedo, expected[i], tolerance) << alpha << ' ' << cosines[i];
        }
}

TEST(LtcTable, SplitsWhatSchlicksTermTakes) {
    for (const LtcRecord& record : ltc_table()) {
        ASSERT_GE(record.fresnel, 0);
        ASSERT_LE(record.fresnel, record.albedo);
        ASSERT_LE(record.albedo, 1.0001f);
    }
    EXPECT_NEAR(ltc_at(0.5, 1).fresnel, 0, 1e-3) << "a mirror seen from above";
    EXPECT_GT(ltc_at(0.05, 0.02).fresnel, 0.7) << "a mirror seen along itself";
}

TEST(LtcTable, BendsTheCosineForward) {
    for (const LtcRecord& r : ltc_table()) {
        ASSERT_GT(r.m22, 0);
        ASSERT_GT(r.m11 * r.m33 - r.m13 * r.m31, 0) << "or the outline would turn around";
        ASSERT_LE(r.m13, 5e-3f) << "away from the eye";
    }
    const Ltc mirror = ltc_at(0.1, std::cos(pi / 4));
    EXPECT_NEAR(mirror.m13, -std::numbers::sqrt2 / 2, 5e-3);
    EXPECT_NEAR(mirror.m33, std::numbers::sqrt2 / 2, 5e-3);
}

/// The integral of |GGX - table| over the albedo, over halves of the sphere by polar angle and azimuth around the mirror
/// direction.
double difference(double roughness, double eye_cosine) {
    const Ltc ltc = ltc_at(roughness, eye_cosine);
    const glm::dmat3 forward = matrix(ltc), back = glm::inverse(forward);
    SurfacePoint surface;
    surface.normal = {0, 0, 1};
    surface.roughness = roughness;
    surface.metallic = 1;
    const glm::dvec3 eye(std::sqrt(1 - eye_cosine * eye_cosine), 0, eye_cosine);
    constexpr int steps = 700;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double z = (i + 0.5) / steps, angle = pi * (j + 0.5) / steps, r = std::sqrt(1 - z * z);
            const glm::dvec3 l(r * std::cos(angle), r * std::sin(angle), z), bent = back * l;
            const double length = glm::length(bent);
            const double table =
                ltc.albedo * std::max(0.0, bent.z) / (pi * std::abs(glm::determinant(forward)) * std::pow(length, 4));
            sum += std::abs(brdf(surface, l, eye).x * z - table) * 2 * pi / (double(steps) * steps);
        }
    return sum / ltc.albedo;
}

TEST(LtcTable, IsNearTheLobe) {
    const std::array<std::array<double, 3>, 6> rows = {
        {{0.3, 0.95, 0.02}, {0.3, 0.6, 0.08}, {0.53, 0.95, 0.05}, {0.53, 0.4, 0.2}, {0.8, 0.4, 0.1}, {1.0, 0.4, 0.08}}};
    for (const auto& [roughness, cosine, most] : rows)
        EXPECT_LE(difference(roughness, cosine), most) << roughness << ' ' << cosine;
}

// A square above a glossy floor, seen from the other side: where its highlight is.
TEST(AreaLights, HighlightsAreNearTheTruth) {
    const Frame frame = tiny::frame(8, 8);
    Light square;
    square.type = LightType::rectangle;
    square.position = {0, 0.8, 6};
    square.direction = {0, 0, -1};
    square.half_extent = {0.4f, 0.4f};
    square.range = 1e6f;
    for (const auto& [roughness, most] :
         {std::pair(0.15, 0.015), std::pair(0.3, 0.02), std::pair(0.5, 0.03), std::pair(0.8, 0.01)}) {
        double worst = 0, brightest = 0;
        for (int i = 0; i < 40; ++i) {
            SurfacePoint floor;
            floor.metallic = 1;
            floor.roughness = roughness;
            floor.normal = {0, 1, 0};
            floor.position = {0.02 * i, -0.6, 2 + 0.08 * i};
            const double exact = exact_reflected(frame, floor, square).x;
            worst = std::max(worst, std::abs(reflected(frame, floor, square).x - exact));
            brightest = std::max(brightest, exact);
        }
        EXPECT_GT(brightest, 0.02);
        EXPECT_LE(worst, most) << "of a radiance of 1, at roughness " << roughness << "; the brightest is " << brightest;
    }
}

}  // namespace
}  // namespace strata
