// What the scenarios of transparency claim about themselves, counted on their fragments.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <ranges>
#include <span>
#include <vector>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame_features.h"
#include "captures/scenarios.h"
#include "passes/reference/fragments.h"
#include "passes/scene/object_order.h"

namespace strata {
namespace {

Frame build(std::string_view name, std::uint32_t width = 64, std::uint32_t height = 36) {
    return (*find_scenario(name))->build(0, {.width = width, .height = height});
}

/// With nothing opaque before them.
FragmentLists all_fragments(const Frame& frame) {
    return transparent_fragments(frame, ReferenceImage(frame.view.width, frame.view.height, frame.view.samples));
}

/// Front to back over black.
double composited(std::span<const Fragment> fragments) {
    std::vector<Fragment> sorted(fragments.begin(), fragments.end());
    std::ranges::sort(sorted, {}, &Fragment::depth);
    double color = 0, transmittance = 1;
    for (const Fragment& fragment : sorted) {
        color += transmittance * fragment.color.x;
        transmittance *= fragment.transmittance.x;
    }
    return color;
}

TEST(TransparentScenarios, ThinLayersAreTwoNumbers) {
    const Frame frame = build("thin_layers");
    const FragmentLists fragments = all_fragments(frame);
    EXPECT_EQ(fragments.total(), 200u * 64 * 36);
    for (const std::uint32_t x : {0u, 31u}) EXPECT_NEAR(composited(fragments.at(x, 18)), .296181, 1e-6);
    for (const std::uint32_t x : {32u, 63u}) EXPECT_NEAR(composited(fragments.at(x, 18)), .569839, 1e-6);
}

TEST(TransparentScenarios, AParticleStormIsEightLayersDeepAtAnyExtent) {
    for (const auto& [width, height] : {std::pair(64u, 36u), std::pair(150u, 40u)}) {
        const double layers = double(all_fragments(build("particle_storm", width, height)).total()) / (width * height);
        EXPECT_GT(layers, 7) << width;
        EXPECT_LT(layers, 9) << width;
    }
}

/// Through the middle of the view five spheres of a row, by their front faces .3 m before their middles.
TEST(TransparentScenarios, FiveFrontFacesOfSpheresLieOverTheMiddle) {
    const Frame frame = build("spheres_125", 65, 37);
    ASSERT_EQ(frame.draws.size(), 127u);
    std::vector<double> depths;
    const FragmentLists fragments = all_fragments(frame);
    for (const Fragment& fragment : fragments.at(32, 18)) depths.push_back(fragment.depth);
    std::ranges::sort(depths);
    ASSERT_EQ(depths.size(), 5u);
    for (std::size_t i = 0; i < depths.size(); ++i) EXPECT_NEAR(depths[i], 3.7 + double(i), .003) << i;
}

TEST(TransparentScenarios, TheFacadeHasThreeSkinsThenSmokeThenCars) {
    const Frame frame = build("facade_at_150m");
    EXPECT_NEAR(glm::length(frame.view.origin - glm::dvec3(0, 3, 0)), 150, .1);
    std::vector<double> skins, cars;  // how far behind the facade
    for (const Draw& draw : frame.draws) {
        if (draw.name.ends_with("glass")) skins.push_back(-draw.to_world[3].z);
        if (draw.name == "car") cars.push_back(-draw.to_world[3].z);
    }
    std::ranges::sort(skins);
    ASSERT_EQ(skins.size(), 30u);
    EXPECT_NEAR(skins[10] - skins[9], .3, 1e-9);
    EXPECT_NEAR(skins[20] - skins[19], .3, 1e-9);
    EXPECT_EQ(cars.size(), 6u);
    for (const Particle& puff : frame.emitters.at(0).particles) {
        EXPECT_GT(-puff.center.z, skins.back());
        EXPECT_LT(-puff.center.z, std::ranges::min(cars));
    }
    EXPECT_GT(all_fragments(frame).deepest(), 6u);
}

TEST(TransparentScenarios, TheTailLightsCoverIsInFrontOfEveryLensThoughItsMiddleIsNot) {
    const Frame frame = build("tail_light");
    EXPECT_TRUE(frame_features(frame).has(Feature::chromatic));
    const FragmentLists fragments = all_fragments(frame);
    std::size_t over_red = 0;
    for (std::uint32_t y = 0; y < fragments.height(); ++y)
        for (std::uint32_t x = 0; x < fragments.width(); ++x) {
            const std::span<const Fragment> list = fragments.at(x, y);  // the cover is submitted first
            if (list.size() != 2 || list[1].transmittance.y > .1) continue;
            ++over_red;
            EXPECT_GT(list[1].depth - list[0].depth, .002);
            EXPECT_LT(list[1].depth - list[0].depth, .006);
        }
    EXPECT_GT(over_red, 100u);
    const std::vector<std::uint32_t> sorted = back_to_front_draws(frame);
    EXPECT_NE(frame.draws[sorted.back()].name, "clear cover");
    EXPECT_NE(frame.draws[sorted.front()].name, "clear cover");
}

TEST(TransparentScenarios, InterfacesAreOrderedByLayerAndTestedByDepth) {
    const Frame frame = build("interface_layers", 96, 54);
    ASSERT_TRUE(frame_features(frame).has(Feature::interface_layers));
    const double near = double(frame.view.near);
    const FragmentLists fragments = all_fragments(frame);
    std::size_t deepest = 0;
    for (std::uint32_t pixel = 0; pixel < 96 * 54; ++pixel) {
        const std::span<const Fragment> list = fragments.at(pixel % 96, pixel / 96);
        std::vector<double> depths;
        for (const Fragment& fragment : list) depths.push_back(fragment.depth);
        std::ranges::sort(depths);
        const auto world = std::ranges::lower_bound(depths, near) - depths.begin();
        EXPECT_LE(world, 3);
        if (world < 3) continue;
        ++deepest;
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(depths[i], near / double(4 - i), 1e-8);
    }
    EXPECT_GT(deepest, 100u);
}

TEST(TransparentScenarios, AnExplosionBurnsInsideItsSmoke) {
    const Frame frame = build("explosion");
    const Features features = frame_features(frame);
    for (const Feature feature : {Feature::emissive, Feature::distortion, Feature::soft_particles})
        EXPECT_TRUE(features.has(feature)) << name(feature);
    EXPECT_FALSE(features.has(Feature::additive)) << "fire covers, so that every technique can be held against it";
    // In the middle of the picture fire has smoke on both sides.
    const FragmentLists fragments = all_fragments(frame);
    const auto burns = [](const Fragment& fragment) { return fragment.emission.x > 0; };
    const std::span<const Fragment> middle = fragments.at(32, 18);
    ASSERT_TRUE(std::ranges::any_of(middle, burns));
    const double fire = std::ranges::find_if(middle, burns)->depth;
    const auto smokes = [&](bool before) {
        return std::ranges::any_of(middle, [&](const Fragment& f) { return !burns(f) && (f.depth < fire) == before; });
    };
    EXPECT_TRUE(smokes(true));
    EXPECT_TRUE(smokes(false));
}

/// Nearer in some pixels and farther in others: no order of the two draws is right.
bool cross(const std::map<std::uint32_t, double>& a, const std::map<std::uint32_t, double>& b) {
    bool nearer = false, farther = false;
    for (const auto& [pixel, depth] : a)
        if (const auto other = b.find(pixel); other != b.end()) (depth > other->second ? nearer : farther) = true;
    return nearer && farther;
}

TEST(TransparentScenarios, PanesOfTheNightMarketCrossEachOther) {
    const Frame frame = build("night_market", 320, 180);
    std::vector<std::map<std::uint32_t, double>> panes;  // device depth by pixel
    for (std::uint32_t i = 0; i < frame.draws.size(); ++i) {
        if (!frame.draws[i].name.ends_with("glass") || frame.meshes[frame.draws[i].mesh].name != "quad") continue;
        std::mutex guard;
        auto& pixels = panes.emplace_back();
        rasterize(frame, std::span(&i, 1), {}, [&](const RasterPoint& point) {
            const std::lock_guard lock(guard);
            if (point.covered) pixels[point.y * 320 + point.x] = point.depth;
        });
    }
    int crossing = 0;
    for (std::size_t a = 0; a < panes.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) crossing += cross(panes[a], panes[b]);
    EXPECT_GT(crossing, 5);
}

/// What all fragments of a pixel let through of the first channel.
double transmittance(std::span<const Fragment> fragments) {
    double through = 1;
    for (const Fragment& fragment : fragments) through *= fragment.transmittance.x;
    return through;
}

/// As Drobot's talk asks of smoke in a game: a byte has nothing left of it.
TEST(TransparentScenarios, TheCoreOfThickSmokeHidesACharacterCompletely) {
    const Frame frame = build("smoke_core", 96, 54);
    const FragmentLists fragments = all_fragments(frame);
    std::size_t cloud = 0, hidden = 0;
    for (std::uint32_t y = 0; y < 54; ++y)
        for (std::uint32_t x = 0; x < 96; ++x) {
            cloud += !fragments.at(x, y).empty();
            hidden += transmittance(fragments.at(x, y)) < 1. / 255;
        }
    EXPECT_GT(3 * hidden, cloud);
    std::size_t corners = 0;
    for (const Draw& draw : frame.draws) {
        if (frame.materials[draw.material].name != "yellow coat") continue;
        for (const glm::vec3& position : frame.meshes[draw.mesh].positions) {
            const glm::dvec3 world = draw.to_world * glm::dvec4(position, 1);
            const glm::dvec3 seen = frame.view.to_view * (world - frame.view.origin);
            const glm::dvec2 at =
                glm::dvec2(frame.view.projection[0][0], frame.view.projection[1][1]) * glm::dvec2(seen) / seen.z;
            const glm::dvec2 pixel = (at * .5 + .5) * glm::dvec2(96, 54);
            EXPECT_LT(transmittance(fragments.at(std::uint32_t(pixel.x), std::uint32_t(pixel.y))), 1. / 255)
                << world.x << " " << world.y << " " << world.z;
            ++corners;
        }
    }
    EXPECT_GT(corners, 20u);
}

/// T = 1 / 255 is a code of 255: twelve of them in 1.2 mm are three times what a word of 10 bits holds.
TEST(TransparentScenarios, GelsThatArePressedTogetherAreMoreThanAWordHolds) {
    const Frame frame = build("stack_of_gels", 96, 54);
    const FragmentLists fragments = all_fragments(frame);
    std::size_t stacks = 0;
    for (std::uint32_t y = 0; y < 54; ++y)
        for (std::uint32_t x = 0; x < 96; ++x) {
            std::vector<double> depths;
            for (const Fragment& fragment : fragments.at(x, y))
                if (fragment.transmittance.x < 1. / 255 && fragment.transmittance.y > .9) depths.push_back(fragment.depth);
            if (depths.size() != 12) continue;
            const auto [nearest, farthest] = std::ranges::minmax(depths);
            EXPECT_LT(farthest - nearest, .0012);
            ++stacks;
        }
    EXPECT_GT(stacks, 500u);
}

}  // namespace
}  // namespace strata
