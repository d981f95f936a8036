// Why the lights of the reference can be believed: the numbers of docs/algorithms/lighting.md 0.4 and 7, and the truth against
// sums by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "passes/reference/cubature.h"
#include "passes/reference/lights.h"
#include "passes/scene/light_features.h"
#include "passes/scene/shadow_views.h"
#include "passes/shaders/light_features.shared.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {
namespace {

using std::numbers::pi;
const ExactOptions tight = {.visible = {}, .tolerance = 1e-8, .most = 400'000};
constexpr std::array area_types = {LightType::tube, LightType::sphere, LightType::disc, LightType::rectangle};

// White, 5 m before the eye, facing it.
SurfacePoint white(const glm::dvec3& normal = {0, 0, -1}) {
    SurfacePoint surface;
    surface.model = LightingModel::lambert;
    surface.position = {0, 0, 5};
    surface.normal = glm::normalize(normal);
    return surface;
}

SurfacePoint metal(double roughness) {
    SurfacePoint surface = white();
    surface.model = LightingModel::ggx;
    surface.metallic = 1;
    surface.roughness = roughness;
    return surface;
}

// Between the eye and the surface, `distance` from it, shining at it; the window is 1.
Light lamp(LightType type, double distance) {
    Light light;
    light.type = type;
    light.position = {0, 0, 5 - distance};
    light.direction = {0, 0, 1};
    light.range = 1e9f;
    return light;
}

Light sized(Light light, float radius, const glm::vec2& half_extent = glm::vec2(0)) {
    light.source_radius = radius;
    light.half_extent = half_extent;
    return light;
}

const Frame& view() {
    static const Frame frame = tiny::frame(8, 8);
    return frame;
}

double irradiance(const Light& light) { return reflected(view(), white(), light).x * pi; }
double exact_irradiance(const Light& light) { return exact_reflected(view(), white(), light, tight).x * pi; }

glm::dvec3 direction(tiny::Random& random) {
    const double z = random.between(-1, 1), angle = random.between(0, 2 * pi), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

// Somewhere around the white surface, turned anyhow.
Light any_area_light(LightType type, tiny::Random& random) {
    Light light = lamp(type, 0);
    const glm::dvec3 place = direction(random) * random.between(1.1, 2.5), along = direction(random);
    light.position = glm::dvec3(0, 0, 5) + place;
    light.direction = glm::vec3(along);
    light.axis_u = glm::normalize(glm::cross(light.direction, glm::vec3(direction(random))));
    light.source_radius = float(random.between(0.05, 0.4));
    light.half_extent = {float(random.between(0.1, 0.6)), float(random.between(0.1, 0.6))};
    return light;
}

TEST(AreaLights, TubesHaveTheIrradianceOfT03) {
    // Thin, parallel, one meter above, half as long on each side; what the ends add falls with the radius.
    const Light thin = sized(lamp(LightType::tube, 1), 1e-5f, {1, 0});
    EXPECT_NEAR(irradiance(thin) / (2 * 1e-5), 1.28539816, 1e-5);
    EXPECT_NEAR(exact_irradiance(thin) / (2 * 1e-5), 1.28539816, 1e-5);
    // Endless, and not even thin: pi R L / h.
    for (const float radius : {0.05f, 0.5f}) {
        const Light endless = sized(lamp(LightType::tube, 1), radius, {1e4f, 0});
        EXPECT_NEAR(irradiance(endless), pi * double(radius), 1e-6);
        EXPECT_NEAR(exact_irradiance(endless), pi * double(radius), 1e-6);
    }
}

TEST(AreaLights, SpheresDiscsAndSquaresHaveTheIrradianceOfT04) {
    const Light sphere = sized(lamp(LightType::sphere, 2), 0.5f), disc = sized(lamp(LightType::disc, 1), 0.5f);
    const Light square = sized(lamp(LightType::rectangle, 1), 0, {0.5f, 0.5f});
    EXPECT_NEAR(exact_irradiance(sphere), pi / 16, 1e-8);
    EXPECT_NEAR(exact_irradiance(disc), 0.62831853, 1e-8);
    EXPECT_NEAR(exact_irradiance(square), 0.75227469, 1e-8);
    EXPECT_NEAR(irradiance(square), 0.75227469, 1e-8);
    // Sixteen corners of the circle's area instead of the circle.
    EXPECT_NEAR(irradiance(sphere) / (pi / 16), 1, 1e-5);
    EXPECT_NEAR(irradiance(disc) / 0.62831853, 1, 3e-5);
}

// What a unit square facing along +z, with its center at the origin, sends of what it emits to another.
double form_factor(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& normal) {
    const auto received = [&](glm::dvec2 p) {
        SurfacePoint surface = white(normal);
        surface.position = corner + u * p.x + v * p.y;
        Light square = lamp(LightType::rectangle, 5);
        square.half_extent = {0.5f, 0.5f};
        return reflected(view(), surface, square);
    };
    return integral(received, {.tolerance = 1e-7, .most = 100'000}).x;
}

TEST(AreaLights, SquaresOfAClosedCubeSeeNothingElseT05) {
    const double opposite = form_factor({-0.5, -0.5, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1});
    const double adjacent = form_factor({0.5, -0.5, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0});
    EXPECT_NEAR(opposite, 0.19982490, 1e-6);
    EXPECT_NEAR(adjacent, 0.20004378, 1e-6);
    EXPECT_NEAR(opposite + 4 * adjacent, 1, 5e-6);
}

TEST(AreaLights, TheirOutlinesHoldTheIrradianceOfTheirSurfaces) {
    for (const LightType type : area_types) {
        tiny::Random random(7);
        // Rectangles are polygons; of circles, those that the horizon cuts are off the most.
        const double tolerance = type == LightType::rectangle ? 1e-5 : 2e-3;
        int compared = 0;
        for (int i = 0; i < 200; ++i) {
            const Light light = any_area_light(type, random);
            const double sum = reflected(view(), white({0.3, 0.2, -1}), light).x;
            const double exact = exact_reflected(view(), white({0.3, 0.2, -1}), light, {.tolerance = 1e-6}).x;
            EXPECT_NEAR(sum, exact, tolerance * std::max(exact, 0.05)) << "type " << int(type) << ", light " << i;
            compared += exact > 0.01 ? 1 : 0;
        }
        EXPECT_GT(compared, 8);
    }
}

TEST(AreaLights, AreOnceEachForEveryModel) {
    // Of what the truth reflects on the whole of a floor under a small globe: sums, so that a lobe's shape is not asked for.
    const std::array<std::pair<LightingModel, double>, 6> models = {{{LightingModel::burley, 0.04},
                                                                     {LightingModel::plain_burley, 0.04},
                                                                     {LightingModel::multiscatter_ggx, 0.02},
                                                                     {LightingModel::cloth, 0.1},
                                                                     {LightingModel::skin, 0.1},
                                                                     {LightingModel::hair, 0.1}}};
    const Light globe = sized(lamp(LightType::sphere, 1), 0.3f);
    for (const auto& [model, tolerance] : models) {
        double fast = 0, exact = 0;
        for (int i = 0; i < 60; ++i) {
            SurfacePoint surface = white(model == LightingModel::hair ? glm::dvec3(1, 0, 0) : glm::dvec3(0.2, 0, -1));
            surface.model = model;
            surface.roughness = 0.5;
            surface.base_color = {0.7, 0.5, 0.3};
            surface.position = {0.4 * (i % 10) - 1.8, 0.4 * double(i / 10) - 1, 5};
            fast += reflected(view(), surface, globe).y;
            exact += exact_reflected(view(), surface, globe).y;
        }
        EXPECT_GT(exact, 0.1);
        EXPECT_NEAR(fast / exact, 1, tolerance) << int(model);
    }
}

TEST(AreaLights, FarAwayTheyArePoints) {
    const double far = 200, radius = 0.1, half = 0.3;
    Light tube = sized(lamp(LightType::tube, far), float(radius), {float(half), 0});
    EXPECT_NEAR(irradiance(tube) * far * far, 4 * radius * half + pi * radius * radius, 1e-3 * 4 * radius * half) << "broadside";
    tube.axis_u = {0, 0, 1};
    EXPECT_NEAR(irradiance(tube) * far * far, pi * radius * radius, 1e-2 * radius * radius) << "end on";
    const Light sphere = sized(lamp(LightType::sphere, far), float(radius));
    EXPECT_NEAR(irradiance(sphere) * far * far, pi * radius * radius, 1e-4 * radius * radius);
    Light disc = sized(lamp(LightType::disc, far), float(radius));
    disc.direction = {0.6f, 0, 0.8f};
    EXPECT_NEAR(irradiance(disc) * far * far, 0.8 * pi * radius * radius, 1e-4 * radius * radius);
    Light square = sized(lamp(LightType::rectangle, far), 0, {float(half), float(half)});
    EXPECT_NEAR(irradiance(square) * far * far, 4 * half * half, 1e-4 * half * half);
    square.direction = {0, 0, -1};
    EXPECT_EQ(irradiance(square), 0) << "it has turned its back";
}

// The square light by a million equal parts: nothing of the cubature, its pieces and its search for peaks.
double by_hand(const SurfacePoint& surface, const Light& square) {
    constexpr int steps = 1000;
    const double half = double(square.half_extent.x), area = 4 * half * half / (double(steps) * steps);
    const glm::dvec3 v = glm::normalize(-surface.position);
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const glm::dvec3 place(half * ((2 * i + 1.0) / steps - 1), half * ((2 * j + 1.0) / steps - 1), square.position.z);
            const glm::dvec3 to = place - surface.position, l = glm::normalize(to);
            const double cosines = std::max(0.0, glm::dot(l, surface.normal)) * std::max(0.0, -l.z);
            sum += brdf(surface, l, v).x * cosines * area / glm::dot(to, to);
        }
    return sum;
}

TEST(ExactLights, AreTheIntegralOverTheEmitter) {
    const Light square = sized(lamp(LightType::rectangle, 1), 0, {0.5f, 0.5f});
    SurfacePoint matt = white(), glossy = metal(0.3);
    matt.normal = glossy.normal = glm::normalize(glm::dvec3(0.3, -0.2, -1));
    const double diffuse = by_hand(matt, square), peaked = by_hand(glossy, square);
    EXPECT_NEAR(exact_reflected(view(), matt, square, {.tolerance = 1e-6}).x / diffuse, 1, 1e-6);
    EXPECT_NEAR(exact_reflected(view(), glossy, square).x / peaked, 1, 1e-4);
    EXPECT_NEAR(exact_reflected(view(), metal(0.05), square).x, 1, 2e-3) << "a mirror shows the square's radiance";
}

TEST(ExactLights, AreCutByWhatIsNotVisible) {
    const auto left_half = [](const glm::dvec4& point) { return point.x < 0 ? 1.0 : 0.0; };
    for (const LightType type : area_types) {
        const Light light = sized(lamp(type, 1), 0.3f, {0.5f, 0.5f});
        const double whole = exact_irradiance(light);
        const double half = exact_reflected(view(), white(), light, {.visible = left_half, .tolerance = 1e-4}).x * pi;
        EXPECT_NEAR(half / whole, 0.5, 1e-3) << int(type);
    }
    EXPECT_EQ(exact_reflected(view(), white(), lamp(LightType::omni, 1), {.visible = left_half}).x, 0);
}

TEST(SquareSpots, WithoutAFeatherAreLitUpToTheirEdge) {
    EXPECT_EQ(square_edge(1, 0), 1);
    EXPECT_EQ(square_edge(std::nextafter(1.0, 2.0), 0), 0);
    EXPECT_EQ(square_edge(0.9, 0.1), 1);
    EXPECT_NEAR(square_edge(0.95, 0.1), 0.5, 1e-12);
    EXPECT_EQ(square_edge(1, 0.1), 0);
}

TEST(SquareSpots, AreAsWideAsTheirTwoAngles) {
    Light spot = lamp(LightType::square_spot, 1);
    spot.outer_angle = float(std::atan(0.5));
    spot.inner_angle = float(std::atan(0.25));
    const auto lit = [&](double x, double y) {
        SurfacePoint surface = white();
        surface.position += glm::dvec3(x, y, 0);
        return reflected(view(), surface, spot).x;
    };
    EXPECT_NEAR(lit(0, 0), 1 / pi, 1e-6);
    EXPECT_NEAR(lit(0.475, 0) / lit(0.44, 0) * std::pow((1 + 0.475 * 0.475) / (1 + 0.44 * 0.44), 1.5), 0.5, 1e-5);
    EXPECT_GT(lit(0.49, 0.24), 0);
    EXPECT_EQ(lit(0.501, 0), 0);
    EXPECT_EQ(lit(0, 0.2501), 0);
    spot.direction = {0, 0, -1};
    EXPECT_EQ(lit(0, 0), 0) << "behind it";
}

TEST(ClipPlanes, KeepWhatLiesOnTheirSide) {
    Light light = lamp(LightType::omni, 1);
    const double open = irradiance(light);
    light.clip_planes = {{.normal = {0, 0, 1}, .distance = -5}};
    EXPECT_EQ(irradiance(light), open) << "on the plane";
    light.clip_planes.push_back({.normal = {1, 0, 0}, .distance = -1e-6});
    EXPECT_EQ(irradiance(light), 0);
    for (const LightType type : area_types) {
        light.type = type;
        EXPECT_EQ(irradiance(sized(light, 0.3f, {0.5f, 0.5f})), 0);
    }
}

// Two texels across, two down: red, green, blue, white.
Frame with_picture() {
    Frame frame = tiny::frame(1024, 1024, 1, 0.01);
    Texture picture;
    picture.width = picture.height = 2;
    picture.mips = 1;
    for (const int texel : {0x0000ff, 0x00ff00, 0xff0000, 0xffffff})
        for (const int shift : {0, 8, 16, 24}) picture.texels.push_back(std::byte(texel >> shift & 0xff));
    frame.textures.push_back(picture);
    return frame;
}

TEST(Pictures, OfSpotsAreUprightBehindThemAndBlackAround) {
    const Frame frame = with_picture();
    Light spot = lamp(LightType::square_spot, 1);
    spot.outer_angle = spot.inner_angle = float(pi / 4);
    spot.texture = 0;
    const auto color = [&](double x, double y) {
        SurfacePoint surface = white();
        surface.position += glm::dvec3(x, y, 0);
        const double share = std::pow(1 + x * x + y * y, 1.5);
        return reflected(frame, surface, spot) * (pi * share);
    };
    // The light looks along +z with u to the right: v is up, and row 0 of the picture is its upper one.
    EXPECT_LT(glm::length(color(-0.5, 0.5) - glm::dvec3(1, 0, 0)), 1e-6);
    EXPECT_LT(glm::length(color(0.5, 0.5) - glm::dvec3(0, 1, 0)), 1e-6);
    EXPECT_LT(glm::length(color(-0.5, -0.5) - glm::dvec3(0, 0, 1)), 1e-6);
    EXPECT_LT(glm::length(color(0, 0) - glm::dvec3(0.5, 0.5, 0.5)), 1e-6);
    // A quarter of the picture beyond the last texel's center: three quarters of it, one of black; feathered nowhere yet.
    EXPECT_NEAR(color(-0.75, 0.5).x, 0.75, 1e-6);
}

TEST(Pictures, OfRectanglesAreSeenWhereTheMirrorSeesThem) {
    const Frame frame = with_picture();
    Light screen = sized(lamp(LightType::rectangle, 1), 0, {1, 1});
    screen.texture = 0;
    const auto color = [&](double x, double y) {
        SurfacePoint mirror = metal(0.05);
        // Turned so that the eye sees this place of the screen.
        const glm::dvec3 l = glm::normalize(glm::dvec3(x, y, -1));
        mirror.normal = glm::normalize(l + glm::dvec3(0, 0, -1));
        return std::pair(reflected(frame, mirror, screen), exact_reflected(frame, mirror, screen, {.most = 100'000}));
    };
    for (const auto& [place, expected] :
         {std::pair(glm::dvec2(-0.6, 0.6), glm::dvec3(1, 0, 0)), std::pair(glm::dvec2(0.6, 0.6), glm::dvec3(0, 1, 0)),
          std::pair(glm::dvec2(-0.6, -0.6), glm::dvec3(0, 0, 1))}) {
        const auto [fast, exact] = color(place.x, place.y);
        EXPECT_LT(glm::length(fast - expected), 0.05) << place.x << ' ' << place.y;
        EXPECT_LT(glm::length(exact - expected), 0.05) << place.x << ' ' << place.y;
    }
}

TEST(Lights, WithoutRangeOrIntensityAreNotSubmittedN7) {
    Frame frame = tiny::frame(8, 8);
    Light spot = lamp(LightType::round_spot, 1), dead = spot, dark = spot;
    dead.range = 0;
    dead.shadow.casts = spot.shadow.casts = true;
    dark.intensity = glm::vec3(0);
    Light moon = lamp(LightType::directional, 0);
    moon.range = 0;
    frame.lights = {dead, dark, spot, moon};
    ASSERT_EQ(light_list(frame).size(), 2u);
    EXPECT_EQ(light_list(frame)[1].type, LightType::directional);
    ASSERT_EQ(shadow_views(frame).size(), 1u);
    EXPECT_EQ(shadow_views(frame)[0].light, 0u) << "in the order of the lights that are there";
    EXPECT_EQ(reflected(frame, white(), dead), glm::dvec3(0));
}

TEST(Lights, DarksTakeAwayInAnyOrderT71) {
    // One watt per steradian from one meter gives 1 / pi.
    const auto sum = [](std::initializer_list<double> intensities) {
        double total = 0;
        for (const double intensity : intensities) {
            Light light = lamp(LightType::omni, 1);
            light.intensity = glm::vec3(float(intensity * pi));
            total += reflected(view(), white(), light).x;
        }
        return total;
    };
    EXPECT_NEAR(sum({10, -3}), 7, 1e-6);
    EXPECT_NEAR(sum({-3, 10}), 7, 1e-6);
    EXPECT_NEAR(sum({10, -15}), -5, 1e-6) << "below zero until everything is summed up";
    for (const LightType type : area_types) {
        Light light = sized(lamp(type, 1), 0.2f, {0.3f, 0.3f});
        const double bright = irradiance(light);
        light.intensity = glm::vec3(-1);
        EXPECT_EQ(irradiance(light), -bright);
    }
}

TEST(Lights, AreFiniteWhereverTheyStandN21) {
    for (const double roughness : {0.0, 0.3, 1.0})
        for (int type = 0; type <= int(LightType::directional); ++type)
            for (const double distance : {0.0, 1e-9, 0.01, 0.3, 1e6})
                for (const float size : {0.f, 1e-6f, 0.3f, 1e4f}) {
                    const Light light = sized(lamp(static_cast<LightType>(type), distance), size, glm::vec2(size));
                    for (const SurfacePoint& surface : {metal(roughness), white(), white({1, 0, 0})}) {
                        const glm::dvec3 fast = reflected(view(), surface, light);
                        const glm::dvec3 exact = exact_reflected(view(), surface, light, {.most = 500});
                        ASSERT_TRUE(std::isfinite(fast.x) && fast.x >= 0) << type << ' ' << distance << ' ' << size;
                        ASSERT_TRUE(std::isfinite(exact.x) && exact.x >= 0) << type << ' ' << distance << ' ' << size;
                    }
                }
}

TEST(LightFeatures, AreTheBitsALightNeeds) {
    Light light = lamp(LightType::round_spot, 1);
    EXPECT_EQ(light_features(light), feature_round_spot);
    light.texture = 0;
    light.clip_planes.resize(1);
    light.intensity.y = -1;
    light.shadow.casts = true;
    const std::uint32_t bits = feature_projected_texture | feature_clip_planes | feature_darks | feature_shadows;
    EXPECT_EQ(light_features(light) & bits, bits);
    light = lamp(LightType::omni, 1);
    light.texture = 0;
    EXPECT_EQ(light_features(light), feature_omni) << "bulbs throw no pictures";
    light.portals = {0};
    EXPECT_EQ(light_features(light), feature_omni) << "a hole in nothing";
    light.blockers = {0};
    EXPECT_EQ(light_features(light), feature_omni | feature_blockers | feature_portals);
    Frame frame = tiny::frame(8, 8);
    frame.lights = {light, lamp(LightType::tube, 1), lamp(LightType::disc, 1)};
    frame.lights[2].range = 0;
    EXPECT_EQ(light_features(frame, light_list(frame)), feature_omni | feature_blockers | feature_portals | feature_tube);
}

}  // namespace
}  // namespace strata
