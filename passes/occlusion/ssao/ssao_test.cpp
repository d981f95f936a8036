// Facts of screen-space ambient occlusion, on the model: planes, walls, and what must not divide by nothing.
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/reference/shade.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::occlusion {

Technique ssao();
ImageSet ssao_model(const StageInput&, const Settings&);

namespace {

using std::numbers::pi;

constexpr double tan_half_height = 0.668178638;  // of 67.5 degrees, which X-Ray's constants are made for

/// normal . p = distance, view space.
struct Plane {
    glm::dvec3 normal;
    double distance;
};

/// The nearest of the planes under each pixel, with exact depths.
struct Scene {
    Frame frame;
    ImageSet before;

    Scene(std::uint32_t width, std::uint32_t height, const std::vector<Plane>& planes, std::uint32_t samples = 1)
        : frame(one_pixel(samples)) {
        frame.view.width = width;
        frame.view.height = height;
        frame.view.projection[0][0] = float(height / (tan_half_height * width));
        frame.view.projection[1][1] = float(-1 / tan_half_height);
        ReferenceImage normals(width, height, samples),
            materials(width, height, samples, {double(LightingModel::lambert), 0, 1, 0});
        for (std::uint32_t s = 0; s < samples; ++s)
            for (std::uint32_t y = 0; y < height; ++y)
                for (std::uint32_t x = 0; x < width; ++x) normals.at(x, y, s) = nearest(planes, x, y);
        before = {{"surface_normal", normals}, {"surface_material", materials}};
    }
    ReferenceImage occlusion(const std::vector<std::string>& sets = {}) const {
        static const Technique technique = ssao();
        Settings settings(technique.params);
        for (const std::string& set : sets) {
            const std::size_t equals = set.find('=');
            EXPECT_TRUE(settings.set(set.substr(0, equals), std::string_view(set).substr(equals + 1))) << set;
        }
        return ssao_model({frame, before}, settings).at("occlusion");
    }
    glm::dvec4& surface(std::uint32_t x, std::uint32_t y, std::uint32_t s = 0) { return before.at("surface_normal").at(x, y, s); }

private:
    glm::dvec4 nearest(const std::vector<Plane>& planes, std::uint32_t x, std::uint32_t y) const {
        const glm::dvec3 ray = pixel_ray(frame, x + 0.5, y + 0.5);
        glm::dvec4 found(0);
        for (const Plane& plane : planes) {
            const double z = plane.distance / glm::dot(plane.normal, ray);
            if (z > 0 && (found.w == 0 || z < found.w)) found = glm::dvec4(plane.normal, z);
        }
        return found;
    }
};

std::vector<std::vector<std::string>> all_kinds() {
    std::vector<std::vector<std::string>> kinds;
    for (const std::string form : {"horizon", "xray"})
        for (const std::string taps : {"8", "12", "24", "96"})
            for (const std::string noise : {"none", "interleaved", "hash"})
                kinds.push_back({"ao_form=" + form, "ao_taps=" + taps, "ao_noise=" + noise, "ao_blur=off"});
    kinds.push_back({"ao_form=horizon"});
    kinds.push_back({"ao_resolution=half"});
    kinds.push_back({"ao_resolution=half", "ao_form=xray", "ao_edge_stop=depth"});
    return kinds;
}

std::string text(const std::vector<std::string>& sets) {
    std::string all;
    for (const std::string& set : sets) all += set + " ";
    return all;
}

const Plane floor_plane{{0, 1, 0}, -1.5};
const Plane leaning_plane{glm::normalize(glm::dvec3(0.3, 0.5, -0.8)), -2};

double wall_leaves(double share_of_radius) {
    const double c = share_of_radius;
    return 1 - (std::acos(c) - c * std::sqrt(1 - c * c)) / pi;
}

}  // namespace

TEST(Ssao, OfAPlaneWithExactDepthIsExactly1) {
    for (const Plane& plane : {floor_plane, leaning_plane})
        for (const auto& sets : all_kinds()) {
            const ReferenceImage image = Scene(32, 18, {plane}).occlusion(sets);
            for (const glm::dvec4& texel : image.texels) ASSERT_NEAR(texel.x, 1, 1e-12) << text(sets);
        }
}

// The wall faces the eye; the floor before it is looked at from 1.5 m above.
TEST(Ssao, HorizonsBeforeAWallLeaveWhatTheClosedFormSays) {
    const Scene scene(192, 108, {floor_plane, {{0, 0, -1}, -6}});
    const ReferenceImage image = scene.occlusion({"ao_taps=96", "ao_radius=2m"});
    int compared = 0;
    for (std::uint32_t y = 54; y < 108; y += 3) {
        const glm::dvec4 surface = scene.before.at("surface_normal").at(96, y);
        const double away = 6 - surface.w;
        if (surface.y == 0 || away < .2 || away > 2.4) continue;
        const double error = image.at(96, y).x - (away < 2 ? wall_leaves(away / 2) : 1);
        EXPECT_NEAR(error, 0, .03) << away << " m from the wall";
        ++compared;
    }
    EXPECT_GE(compared, 4);
}

// Both planes of a corner 3 m away, wherever they occlude each other: what lies beyond the picture or between taps is missed.
TEST(Ssao, AtItsDefaultRadiusIsNearTheClosedFormOfACorner) {
    const double wall = 3, eye_height = 1.5;
    const Scene scene(160, 90, {floor_plane, {{0, 0, -1}, -wall}});
    const auto bias = [&](double radius, const std::vector<std::string>& sets) {
        const ReferenceImage image = scene.occlusion(sets);
        double sum = 0, count = 0;
        for (std::uint32_t y = 0; y < 90; ++y)
            for (std::uint32_t x = 0; x < 160; ++x) {
                const glm::dvec4 surface = scene.before.at("surface_normal").at(x, y);
                const glm::dvec3 at = pixel_ray(scene.frame, x + 0.5, y + 0.5) * surface.w;
                const double away = surface.y != 0 ? wall - at.z : at.y + eye_height;
                if (away >= radius) continue;
                sum += image.at(x, y).x - wall_leaves(away / radius);
                ++count;
            }
        return sum / count;
    };
    EXPECT_NEAR(bias(0.5, {}), 0, 0.03);
    EXPECT_GT(bias(2, {"ao_radius=2m"}), 0.06);
}

TEST(Ssao, SlicesTurnAboutTheWayToTheEyeSoThatTheBorderOfThePictureIsAsDarkAsItsMiddle) {
    const Scene scene(192, 108, {floor_plane, {{0, 0, -1}, -6}});
    const ReferenceImage image = scene.occlusion({"ao_taps=96", "ao_radius=2m"});
    for (std::uint32_t y = 70; y < 84; y += 4) EXPECT_NEAR(image.at(24, y).x, image.at(96, y).x, .03) << y;
}

TEST(Ssao, XRayInAPitIsWhatTheWeightsOfTheChapterGive) {
    // A pixel half a meter behind all others: taps at l = .51 and .53 m with influences .985 and .944.
    Scene scene(320, 180, {{{0, 0, -1}, -9.5}});
    scene.surface(160, 90).w = 10;
    const ReferenceImage image = scene.occlusion({"ao_form=xray", "ao_radius=2m", "ao_taps=8", "ao_blur=off"});
    EXPECT_NEAR(image.at(160, 90).x, .608, .01);
}

TEST(Ssao, WhereNothingIsInReachIs1) {
    Scene scene(32, 18, {});
    scene.surface(10, 9) = {0, 0, -1, 5};
    for (const auto& sets : all_kinds())
        for (const glm::dvec4& texel : scene.occlusion(sets).texels) ASSERT_EQ(texel.x, 1) << text(sets);
    Scene far(32, 18, {leaning_plane});
    for (glm::dvec4& texel : far.before.at("surface_normal").texels) texel.w *= 1e4;  // pixels are farther apart than the radius
    for (const auto& sets : all_kinds())
        for (const glm::dvec4& texel : far.occlusion(sets).texels) ASSERT_EQ(texel.x, 1) << text(sets);
}

TEST(Ssao, StaysWithin0And1WhateverTheSurfacesAre) {
    Scene scene(32, 18, {floor_plane, {{0, 0, -1}, -3}});
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    scene.surface(10, 12) = {0, 0, 0, 1.5};    // no normal
    scene.surface(12, 12) = {0, 0, 1, 1.5};    // faces away
    scene.surface(14, 12) = {nan, 0, 0, 1.5};  // no number
    scene.surface(16, 12) = {0, 0, -1, 1e-6};  // before the lens
    scene.surface(18, 12) = {0, 0, -1, 1e9};
    for (const auto& sets : all_kinds())
        for (const glm::dvec4& texel : scene.occlusion(sets).texels)
            ASSERT_TRUE(texel.x >= 0 && texel.x <= 1) << texel.x << " " << text(sets);
}

TEST(Ssao, DepthErrorHidesTheStepsOfACodedDepthAndNoMore) {
    Scene coded(64, 36, {leaning_plane});
    const double step = std::log(1e5) / 61439;
    for (glm::dvec4& texel : coded.before.at("surface_normal").texels)
        texel.w = .125 * std::exp(step * std::round(std::log(texel.w / .125) / step));
    const auto deviating = [&](const std::string& error) {
        std::size_t count = 0;
        for (const glm::dvec4& texel : coded.occlusion({"ao_depth_error=" + error, "ao_bias=0", "ao_blur=off"}).texels)
            count += texel.x < 1;
        return count;
    };
    EXPECT_EQ(deviating("1e-4"), 0u);
    EXPECT_GT(deviating("1e-5"), 100u);
}

TEST(Ssao, DarkerOfBothDividesByTheMaterialsOcclusion) {
    Scene scene(48, 27, {floor_plane, {{0, 0, -1}, -3}});
    for (glm::dvec4& texel : scene.before.at("surface_material").texels) texel.z = .8;
    const ReferenceImage product = scene.occlusion(), darker = scene.occlusion({"ao_material=min"});
    for (std::size_t i = 0; i < product.texels.size(); ++i)
        EXPECT_NEAR(.8 * darker.texels[i].x, std::min(.8, product.texels[i].x), 1e-12);
}

TEST(Ssao, AtPlainPixelsTheFirstSampleStandsForAll) {
    Scene scene(32, 18, {floor_plane, {{0, 0, -1}, -3}}, 4);
    for (std::uint32_t s = 1; s < 4; ++s)
        for (std::uint32_t x = 0; x < 32; ++x) scene.surface(x, 12, s) = {0, 0, -1, 1.9};
    scene.before["edges"] = ReferenceImage(32, 18, 1, glm::dvec4(1));
    const ReferenceImage each = scene.occlusion();
    EXPECT_NE(each.at(9, 12, 3).x, each.at(9, 12, 0).x);
    scene.before["edges"] = ReferenceImage(32, 18, 1, glm::dvec4(0));
    for (const char* resolution : {"full", "half"}) {
        const ReferenceImage plain = scene.occlusion({std::string("ao_resolution=") + resolution});
        for (std::uint32_t x = 0; x < 32; ++x) EXPECT_EQ(plain.at(x, 12, 3).x, plain.at(x, 12, 0).x);
    }
}

TEST(Ssao, InterleavedNoiseRepeatsEvery4PixelsAndHashedNoiseMovesWithTheFrame) {
    Scene scene(64, 36, {floor_plane, {{0, 0, -1}, -3}});
    const auto still = scene.occlusion({"ao_blur=off"}), moved = scene.occlusion({"ao_blur=off", "ao_noise=hash"});
    scene.frame.index = 1;
    EXPECT_EQ(scene.occlusion({"ao_blur=off"}).texels, still.texels);
    EXPECT_NE(scene.occlusion({"ao_blur=off", "ao_noise=hash"}).texels, moved.texels);
}

TEST(Ssao, DeclaresOnlyTheStepsThatItsSettingsAskFor) {
    const auto steps = [](const std::vector<std::string>& sets) {
        const Technique technique = ssao();
        Settings settings(technique.params);
        for (const std::string& set : sets) {
            const std::size_t equals = set.find('=');
            EXPECT_TRUE(settings.set(set.substr(0, equals), std::string_view(set).substr(equals + 1)));
        }
        Graph graph;
        FrameImages images;
        images.extent = {9, 5};
        technique.declare(graph, images, settings);
        EXPECT_EQ(graph.shape(images.occlusion).extent, (Extent{9, 5}));
        return graph.steps().size();
    };
    EXPECT_EQ(steps({"ao_blur=off"}), 1u);
    EXPECT_EQ(steps({}), 2u);
    EXPECT_EQ(steps({"ao_resolution=half", "ao_blur=off"}), 2u);
    EXPECT_EQ(steps({"ao_resolution=half"}), 3u);
}

}  // namespace strata::occlusion
