// Why transparent_fragments() can be believed: fragments by hand, and what is dropped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "capture_format/frame.h"
#include "passes/reference/fragments.h"
#include "passes/reference/shade.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {
namespace {

constexpr tiny::PixelRect everywhere = {.left = -4, .top = -4, .right = 12, .bottom = 12};

// Nearest first, later submissions nearer at equal depth; then front to back (docs/algorithms/transparency.md 1).
glm::dvec3 composite(std::span<const Fragment> list, glm::dvec3 behind) {
    std::vector<Fragment> sorted(list.begin(), list.end());
    std::sort(sorted.begin(), sorted.end(), [](const Fragment& a, const Fragment& b) {
        return a.depth != b.depth ? a.depth < b.depth : a.submission > b.submission;
    });
    glm::dvec3 sum(0), through(1);
    for (const Fragment& f : sorted) {
        sum += through * (f.color + f.emission);
        through *= f.transmittance;
    }
    return sum + through * behind;
}

std::span<const Fragment> middle(const FragmentLists& lists) { return lists.at(4, 5); }

Particle particle_at(glm::dvec3 center, float alpha) {
    Particle particle;
    particle.center = center;
    particle.size = 100;
    particle.alpha = alpha;
    return particle;
}

TEST(TransparentFragments, GlassMultipliesPerChannelR3) {
    Frame frame = tiny::frame(8, 8);
    // A pane that scatters nothing: base color black.
    for (const auto& [z, k] : {std::pair(3.0, glm::vec3(0.2f, 1, 0.2f)), std::pair(2.0, glm::vec3(1, 0.2f, 0.2f))}) {
        Material& material = tiny::material(frame, tiny::add_quad(frame, everywhere, z, AlphaMode::blend));
        material.base_color = {0, 0, 0, 1};
        material.transmission = k;
    }
    const FragmentLists lists = transparent_fragments(frame, tiny::no_depth(frame));
    ASSERT_EQ(middle(lists).size(), 2u);
    EXPECT_LT(glm::length(composite(middle(lists), glm::dvec3(1)) - glm::dvec3(0.2, 0.2, 0.04)), 1e-7);
}

TEST(TransparentFragments, CoverageDimsEmissionBehindItR4) {
    Frame frame = tiny::frame(8, 8);
    Emitter emitter;
    emitter.particles = {particle_at({0, 0, 4}, 0), particle_at({0, 0, 3}, 0.5f)};
    emitter.particles[0].emissive = glm::vec3(0.3f);
    emitter.particles[1].color = glm::vec3(0);
    frame.emitters = {emitter};
    const FragmentLists lists = transparent_fragments(frame, tiny::no_depth(frame));
    EXPECT_NEAR(composite(middle(lists), glm::dvec3(0)).x, 0.15, 1e-7);
}

TEST(TransparentFragments, FoggedFragmentsBlendToThePhysicalResult) {
    // The oracle of docs/algorithms/transparency.md 0.4: f = 0.8 and s = 0.1 at the card; the black background arrives fogged as
    // 0.3.
    Frame frame = tiny::frame(8, 8);
    frame.fog.density = static_cast<float>(-std::log(0.8) / 2);
    frame.fog.color = glm::vec3(0.5f);
    Emitter emitter;
    emitter.particles = {particle_at({0, 0, 2}, 0.5f)};
    frame.emitters = {emitter};
    const Fragment fragment = middle(transparent_fragments(frame, tiny::no_depth(frame)))[0];
    EXPECT_NEAR(fragment.color.x, 0.5 * (0.8 * 1 + 0.1), 1e-7);
    EXPECT_NEAR(composite(std::span(&fragment, 1), glm::dvec3(0.3)).x, 0.60, 1e-7);
}

TEST(TransparentFragments, FogByDistanceThickensTowardsTheRim) {
    Frame frame = tiny::frame(8, 8);
    frame.fog = {.density = 0.3f, .color = glm::vec3(1), .path = FogPath::distance};
    const std::uint32_t draw = tiny::add_quad(frame, everywhere, 2, AlphaMode::blend);
    tiny::material(frame, draw).base_color = {0, 0, 0, 0.5f};
    const FragmentLists lists = transparent_fragments(frame, tiny::no_depth(frame));
    for (std::uint32_t x = 0; x < 8; ++x) {
        const auto fragments = lists.at(x, 1, 0);
        ASSERT_EQ(fragments.size(), 1u);
        const double fog = std::exp(-double(0.3f) * glm::length(2.0 * pixel_ray(frame, x + 0.5, 1.5)));
        EXPECT_NEAR(fragments[0].fog, fog, 1e-7);
        EXPECT_NEAR(fragments[0].color.x, 0.5 * (1 - fog), 1e-7);
    }
}

TEST(TransparentFragments, ColoredGlassHidesOfTheFogWhatItAbsorbs) {
    // By hand: f = .8, s = .1 at the pane; light 1 behind it arrives there as .625 * 1 + .25 = .875, so red (t = 1) gives
    // .8 * .875 + .1 = .8 and green (t = .2) .8 * .2 * .875 + .1 = .24.
    Frame frame = tiny::frame(8, 8);
    frame.fog.density = static_cast<float>(-std::log(0.8) / 2);
    frame.fog.color = glm::vec3(0.5f);
    const std::uint32_t draw = tiny::add_quad(frame, everywhere, 2, AlphaMode::blend);
    tiny::material(frame, draw).base_color = {0, 0, 0, 1};
    tiny::material(frame, draw).transmission = {1, 0.2f, 0.2f};
    const Fragment fragment = middle(transparent_fragments(frame, tiny::no_depth(frame)))[0];
    const glm::dvec3 seen = composite(std::span(&fragment, 1), glm::dvec3(0.5 * 1 + 0.3));
    EXPECT_NEAR(seen.x, 0.8, 1e-7);
    EXPECT_NEAR(seen.y, 0.24, 1e-7);
}

TEST(TransparentFragments, PremultipliedLightWithoutCoverageIsKept) {
    Frame frame = tiny::frame(8, 8);
    const std::uint32_t draw = tiny::add_quad(frame, everywhere, 2, AlphaMode::premultiplied);
    tiny::material(frame, draw).base_color = {2, 1, 0.5f, 0};
    const FragmentLists lists = transparent_fragments(frame, tiny::no_depth(frame));
    const auto fragments = middle(lists);
    ASSERT_EQ(fragments.size(), 1u);
    EXPECT_NEAR(fragments[0].color.x, 2, 1e-6);
    EXPECT_EQ(fragments[0].transmittance, glm::dvec3(1));
}

TEST(TransparentFragments, FogAddsToNothingThatCoversNothing) {
    Frame frame = tiny::frame(8, 8);
    frame.fog.density = static_cast<float>(-std::log(0.5) / 2);
    frame.fog.color = glm::vec3(7);
    const std::uint32_t draw = tiny::add_quad(frame, everywhere, 2, AlphaMode::additive);
    tiny::material(frame, draw).base_color = {1, 0.5f, 0.25f, 0.5f};
    tiny::material(frame, draw).emissive = glm::vec3(1);
    const Fragment fragment = middle(transparent_fragments(frame, tiny::no_depth(frame)))[0];
    EXPECT_LT(glm::length(fragment.emission - 0.5 * 0.5 * glm::dvec3(2, 1.5, 1.25)), 1e-6);
    EXPECT_EQ(fragment.color, glm::dvec3(0));
    EXPECT_EQ(fragment.alpha, 0);
    EXPECT_EQ(fragment.transmittance, glm::dvec3(1));
}

TEST(TransparentFragments, BlendAndPremultipliedDifferInWhoMultiplies) {
    Frame frame = tiny::frame(8, 8);
    for (const AlphaMode mode : {AlphaMode::blend, AlphaMode::premultiplied}) {
        Material& material = tiny::material(frame, tiny::add_quad(frame, everywhere, 2, mode));
        material.base_color = {0.5f, 0.25f, 0, 0.5f};
        material.emissive = glm::vec3(1);
    }
    const FragmentLists lists = transparent_fragments(frame, tiny::no_depth(frame));
    ASSERT_EQ(middle(lists).size(), 2u);
    EXPECT_EQ(middle(lists)[0].color, glm::dvec3(0.75, 0.625, 0.5));
    EXPECT_EQ(middle(lists)[1].color, glm::dvec3(1, 0.75, 0.5));
    EXPECT_EQ(middle(lists)[1].transmittance, glm::dvec3(0.5));
    EXPECT_LT(middle(lists)[0].submission, middle(lists)[1].submission);
}

TEST(TransparentFragments, MeshesAreLitByTheSunAndTheSkyWithoutShadows) {
    Frame frame = tiny::frame(8, 8);
    frame.sun.direction = {0, 0, 1};
    frame.sun.irradiance = glm::vec3(3);
    frame.hemisphere = {.sky = glm::vec3(0.4f), .ground = glm::vec3(0.4f)};
    const double pi = std::acos(-1.0);
    // Something opaque between the sun and the pane, which would shadow it.
    tiny::add_quad(frame, everywhere, 0.5);
    Material& material = tiny::material(frame, tiny::add_quad(frame, everywhere, 2, AlphaMode::blend));
    material.lighting_model = LightingModel::lambert;
    material.base_color = {0.5f, 1, 0, 0.25f};
    const Fragment fragment = middle(transparent_fragments(frame, tiny::no_depth(frame)))[0];
    EXPECT_LT(glm::length(fragment.color - 0.25 * glm::dvec3(0.5, 1, 0) * (3 / pi + 0.4)), 1e-7);
}

TEST(TransparentFragments, SoftParticlesFadeBeforeTheSurfaceBehind) {
    Frame frame = tiny::frame(8, 8);
    Emitter emitter;
    emitter.soft_depth_fade = 2;
    emitter.particles = {particle_at({0, 0, 3.5}, 0.8f)};
    emitter.particles[0].depth_offset = 0.25f;
    frame.emitters = {emitter};
    ReferenceImage depth = tiny::no_depth(frame);
    EXPECT_NEAR(middle(transparent_fragments(frame, depth))[0].alpha, 0.8, 1e-7);
    for (auto& texel : depth.texels) texel.x = 0.125 / 4;
    const Fragment fragment = middle(transparent_fragments(frame, depth))[0];
    EXPECT_NEAR(fragment.alpha, 0.2, 1e-7);
    EXPECT_NEAR(fragment.depth, 3.25, 1e-9);
}

TEST(TransparentFragments, OfInterfacesAreInFrontOfTheWorldAndTestedWhereTheyAre) {
    Frame frame = tiny::frame(8, 8);
    const double near = double(frame.view.near);
    frame.draws[tiny::add_quad(frame, everywhere, 2, AlphaMode::blend)].layer = 1;
    frame.draws[tiny::add_quad(frame, everywhere, 3, AlphaMode::blend)].layer = 4;
    Emitter emitter;
    emitter.particles = {particle_at({0, 0, 1}, 0.8f)};
    emitter.particles[0].depth_offset = 5;
    frame.emitters = {emitter};
    ReferenceImage depth = tiny::no_depth(frame);
    const auto found = transparent_fragments(frame, depth);
    ASSERT_EQ(middle(found).size(), 3u);
    EXPECT_NEAR(middle(found)[0].depth, near / 2, 1e-8);
    EXPECT_NEAR(middle(found)[1].depth, near / 5, 1e-8);
    EXPECT_EQ(middle(found)[2].depth, near) << "an offset takes nothing in front of an interface";
    for (auto& texel : depth.texels) texel.x = near / 2.5;
    EXPECT_EQ(middle(transparent_fragments(frame, depth)).size(), 2u);
}

TEST(TransparentFragments, OnlyWhatIsInFrontOfTheDepthRemains) {
    Frame frame = tiny::frame(8, 8);
    for (const double z : {2.0, 3.0, 4.0}) tiny::add_quad(frame, everywhere, z, AlphaMode::blend);
    ReferenceImage depth = tiny::no_depth(frame);
    for (auto& texel : depth.texels) texel.x = 0.125 / 3.5;
    EXPECT_EQ(middle(transparent_fragments(frame, depth)).size(), 2u);
    EXPECT_FALSE(transparent_fragments(frame, depth).undecided(4, 5));
    for (auto& texel : depth.texels) texel.x = 0.125 / 3;
    EXPECT_TRUE(transparent_fragments(frame, depth).undecided(4, 5)) << "equal depths hang on rounding";
}

TEST(TransparentFragments, FaintFragmentsAreDroppedButLayersOfOnePercentAreNot) {
    Frame frame = tiny::frame(8, 8);
    Emitter emitter;
    for (int i = 0; i < 200; ++i) emitter.particles.push_back(particle_at({0, 0, 2 + 0.01 * i}, 0.01f));
    emitter.particles.push_back(particle_at({0, 0, 1}, 0.9e-5f));
    frame.emitters = {emitter};
    const FragmentLists lists = transparent_fragments(frame, tiny::no_depth(frame));
    EXPECT_EQ(lists.deepest(), 200u);
    EXPECT_EQ(lists.total(), 200u * 64);
    EXPECT_NEAR(composite(middle(lists), glm::dvec3(0)).x, 0.8660203251, 1e-7);  // docs/algorithms/transparency.md R5
}

TEST(TransparentFragments, NotANumberBecomesNothing) {
    Frame frame = tiny::frame(8, 8);
    Emitter emitter;
    emitter.particles = {particle_at({0, 0, 2}, std::numeric_limits<float>::quiet_NaN()), particle_at({0, 0, 3}, 0.5f)};
    emitter.particles[1].color = {std::numeric_limits<float>::infinity(), 1, 1};
    frame.emitters = {emitter};
    const FragmentLists lists = transparent_fragments(frame, tiny::no_depth(frame));
    ASSERT_EQ(middle(lists).size(), 1u);
    EXPECT_EQ(middle(lists)[0].color, glm::dvec3(0, 0.5, 0.5));
}

TEST(TransparentFragments, DepthsAFloatCannotOrderAreUndecidedAndExactTiesAreNot) {
    for (const double gap : {0.0, 1e-7, 1e-4}) {
        Frame frame = tiny::frame(8, 8);
        Emitter emitter;
        emitter.particles = {particle_at({0, 0, 2}, 0.5f), particle_at({0, 0, 2 + gap}, 0.5f)};
        frame.emitters = {emitter};
        EXPECT_EQ(transparent_fragments(frame, tiny::no_depth(frame)).undecided(4, 5), gap == 1e-7) << gap;
    }
}

TEST(TransparentFragments, EverySampleHasItsOwnList) {
    Frame frame = tiny::frame(8, 8, 4);
    tiny::add_quad(frame, {.left = -4, .top = -4, .right = 4.5, .bottom = 12}, 2, AlphaMode::blend);
    const FragmentLists lists = transparent_fragments(frame, tiny::no_depth(frame));
    for (std::uint32_t sample = 0; sample < 4; ++sample) EXPECT_EQ(lists.at(4, 4, sample).size(), sample % 2 == 0 ? 1u : 0u);
    EXPECT_EQ(lists.total(), 8u * (4 * 4 + 2));
}

TEST(TransparentFragments, TwoRunsGiveEqualBits) {
    Frame frame = tiny::frame(64, 48);
    tiny::Random random(7);
    Emitter emitter;
    for (int i = 0; i < 300; ++i) {
        Particle particle = particle_at(random.inside(-2, 2) + glm::dvec3(0, 0, 5), 0.3f);
        particle.size = static_cast<float>(random.between(0.1, 1));
        particle.rotation = static_cast<float>(random.between(0, 6));
        emitter.particles.push_back(particle);
    }
    frame.emitters = {emitter};
    const FragmentLists first = transparent_fragments(frame, tiny::no_depth(frame)),
                        second = transparent_fragments(frame, tiny::no_depth(frame));
    ASSERT_EQ(first.total(), second.total());
    EXPECT_GT(first.deepest(), 10u);
    for (std::uint32_t y = 0; y < 48; ++y) {
        for (std::uint32_t x = 0; x < 64; ++x) {
            const auto a = first.at(x, y), b = second.at(x, y);
            ASSERT_EQ(a.size(), b.size());
            EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), [](const Fragment& p, const Fragment& q) {
                return p.depth == q.depth && p.color == q.color && p.submission == q.submission;
            }));
        }
    }
}

}  // namespace
}  // namespace strata
