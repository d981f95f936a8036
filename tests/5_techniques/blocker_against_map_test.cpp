// Two systems that know nothing of each other on one shadow (docs/algorithms/lighting.md 6.6, T6.7): a light with a blocker, and
// the same light with a shadow map of a quad where the blocker is. They may differ within 1.5 texels of the shadow's edge alone:
// bilinear comparisons reach less than a texel in either direction, 1.41 along the diagonal, and what a map has drawn is exact at
// the centers of its texels.
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/reference/shade.h"
#include "passes/scene/shadow_views.h"
#include "tests/5_techniques/light_scenes.h"

namespace strata {
namespace {

constexpr double edge_texels = 1.5;

struct Quad {
    glm::dvec3 center;
    glm::vec3 u, v;
    float half_u, half_v;

    /// Around its outline.
    std::array<glm::dvec3, 4> corners() const {
        const glm::dvec3 a = glm::dvec3(u) * double(half_u), b = glm::dvec3(v) * double(half_v);
        return {center - a - b, center + a - b, center + a + b, center - a + b};
    }
};

void add_mesh(Frame& frame, const Quad& quad) {
    Mesh mesh;
    for (const glm::dvec3& corner : quad.corners()) {
        mesh.positions.emplace_back(corner);
        mesh.normals.push_back(glm::normalize(glm::cross(quad.u, quad.v)));
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    frame.draws.push_back({.mesh = static_cast<std::uint32_t>(frame.meshes.size())});
    frame.meshes.push_back(std::move(mesh));
}

/// From 5 m above a floor, straight down on 6.2 m x 3.5 m of it; quads above the eye are not in the picture.
Frame floor_from_above() {
    Frame frame;
    frame.view = {.origin = {0, 5, 0},
                  .to_view = glm::transpose(glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, -1, 0})),
                  .projection = perspective(.675, 16. / 9, .1),
                  .width = 160,
                  .height = 90};
    frame.materials.emplace_back();
    frame.materials[0].double_sided = true;
    add_mesh(frame, {.center = {0, 0, 0}, .u = {1, 0, 0}, .v = {0, 0, -1}, .half_u = 40, .half_v = 40});
    return frame;
}

struct Case {
    std::string name;
    Light light;
    Quad quad;
};

Light lamp(LightType type, glm::dvec3 position, glm::vec3 direction) {
    Light light;
    light.type = type;
    light.position = position;
    light.direction = glm::normalize(direction);
    light.axis_u = {0, 0, 1};
    light.intensity = glm::vec3(50);
    light.range = 40;
    light.inner_angle = light.outer_angle = .6f;
    return light;
}

/// Lights that shine on the middle of the floor with a quad in their way.
std::vector<Case> cases() {
    const auto level = [](glm::dvec3 center) {
        return Quad{.center = center, .u = {1, 0, 0}, .v = {0, 0, -1}, .half_u = .6f, .half_v = .35f};
    };
    const auto turned = [](glm::dvec3 center) {
        return Quad{.center = center, .u = {.8f, 0, .6f}, .v = {-.48f, .6f, .64f}, .half_u = .5f, .half_v = .4f};
    };
    return {{"round spot from above", lamp(LightType::round_spot, {0, 10, 0}, {0, -1, 0}), level({.3, 6, .1})},
            {"round spot aslant, turned quad", lamp(LightType::round_spot, {3, 10, 1}, {-3, -10, -1}), turned({1.9, 6.3, .6})},
            {"square spot aslant", lamp(LightType::square_spot, {-2, 9, 1}, {2, -9, -1}), level({-1.3, 6, .6})},
            {"omni light, turned quad", lamp(LightType::omni, {.5, 9, -.5}, {0, -1, 0}), turned({-.2, 6.3, 0})}};
}

Frame unblocked(const Case& tested) {
    Frame frame = floor_from_above();
    frame.lights = {tested.light};
    return frame;
}

Frame with_blocker(const Case& tested) {
    Frame frame = unblocked(tested);
    const Quad& quad = tested.quad;
    frame.blockers = {{.center = quad.center, .u = quad.u, .v = quad.v, .half_u = quad.half_u, .half_v = quad.half_v}};
    frame.lights[0].blockers = {0};
    return frame;
}

Frame with_map(const Case& tested, std::uint32_t map_size) {
    Frame frame = unblocked(tested);
    // Texels of .14 m on a floor under an axis 17 degrees aslant: depth falls by .06 m along a texel's diagonal, right below the
    // light, too, where the ray has no slope. Only the slope bias can make up for that.
    frame.lights[0].shadow = {.casts = true, .map_size = map_size, .bias = .002f};
    add_mesh(frame, tested.quad);
    return frame;
}

ReferenceImage light_of(const Frame& frame) {
    return in_double(lit(frame, "lighting/brute_force", {"shadows/pcf:kernel=0"}).images.at("light"));
}

double distance_to_segment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0., 1.);
    return glm::length(p - (a + t * (b - a)));
}

/// Where a light's map sees the quad's outline and the floor.
class MapOfQuad {
public:
    MapOfQuad(const Frame& frame, const Quad& quad) : frame_(frame), quad_(quad), views_(shadow_views(frame)) {}

    /// How far a point of the floor is from the edge of the quad's shadow, in texels of the map that sees the point.
    double from_edge(const glm::dvec3& point) const {
        const ShadowView& map = serving(point);
        const glm::dvec2 at = in_texels(map, point);
        double least = std::numeric_limits<double>::infinity();
        const auto corners = quad_.corners();
        for (std::size_t i = 0; i < 4; ++i)
            least = std::min(least, distance_to_segment(at, in_texels(map, corners[i]), in_texels(map, corners[(i + 1) % 4])));
        return least;
    }
    /// Edge of a texel where the map sees the floor, meters across the map's axis.
    double texel_at(const glm::dvec3& point) const {
        const ShadowView& map = serving(point);
        return map.texel * clip(map, point).w;
    }

private:
    glm::dvec4 clip(const ShadowView& map, const glm::dvec3& world) const {
        return map.view_to_map * glm::dvec4(to_view(frame_, world), 1);
    }
    glm::dvec2 in_texels(const ShadowView& map, const glm::dvec3& world) const {
        const glm::dvec4 at = clip(map, world);
        return glm::dvec2(at) / at.w * double(map.size);
    }
    const ShadowView& serving(const glm::dvec3& point) const {
        const Light& light = frame_.lights[0];
        return has_faces(light) ? views_[cube_face(point - light.position)] : views_[0];
    }

    const Frame& frame_;
    const Quad& quad_;
    std::vector<ShadowView> views_;
};

struct Compared {
    std::size_t lit = 0, dark = 0;             ///< beyond the edge, as the blocker has it
    std::size_t at_edge = 0, partial = 0;      ///< within it, and of these neither lit nor dark by the map
    std::size_t apart = 0;                     ///< beyond the edge, and not the same
    double least_texel = 1e9, most_texel = 0;  ///< meters on the floor
};

/// Of every pixel that the light reaches. `map` draws the quad of `mapped`, which is the one of `tested` or not.
Compared compare(const Case& tested, const Case& mapped, std::uint32_t map_size) {
    const Frame with = with_map(mapped, map_size);
    const ReferenceImage all = light_of(unblocked(tested)), blocked = light_of(with_blocker(tested)), shadowed = light_of(with);
    const MapOfQuad map(with, tested.quad);
    Compared compared;
    for (std::uint32_t y = 0; y < all.height; ++y)
        for (std::uint32_t x = 0; x < all.width; ++x) {
            if (all.at(x, y).x <= .01) continue;
            const glm::dvec3 ray = to_world(with, pixel_ray(with, x + .5, y + .5)) - with.view.origin;
            const glm::dvec3 point = with.view.origin - ray * (with.view.origin.y / ray.y);
            const double by_blocker = blocked.at(x, y).x / all.at(x, y).x, by_map = shadowed.at(x, y).x / all.at(x, y).x;
            compared.least_texel = std::min(compared.least_texel, map.texel_at(point));
            compared.most_texel = std::max(compared.most_texel, map.texel_at(point));
            if (map.from_edge(point) <= edge_texels) {
                ++compared.at_edge;
                compared.partial += by_map > .01 && by_map < .99;
                continue;
            }
            ++(by_blocker > .5 ? compared.lit : compared.dark);
            compared.apart += std::abs(by_blocker - by_map) > 2e-3;  // halves of light, whose quotient is good to 2^-10
        }
    return compared;
}

TEST(BlockerAgainstMap, TheMasksAreTheSameButForOneAndAHalfTexelsAtTheEdge) {
    for (const Case& tested : cases())
        for (const std::uint32_t map_size : {128u, 512u}) {
            const Compared found = compare(tested, tested, map_size);
            const std::string texel = fmt::format("{}, map of {}: texels of {:.3f} to {:.3f} m on the floor", tested.name,
                                                  map_size, found.least_texel, found.most_texel);
            EXPECT_EQ(found.apart, 0u) << texel;
            EXPECT_GT(found.lit, 1000u) << texel;
            EXPECT_GT(found.dark, 200u) << texel;
            EXPECT_GT(found.partial, 20u) << texel << ": the map has no soft edge, or it is elsewhere";
            EXPECT_LT(found.at_edge, (found.lit + found.dark) / 2) << texel << ": most is edge, and was not compared";
        }
}

TEST(BlockerAgainstMap, TexelsOnTheFloorAreAsLargeAsTheConeOfTheLightSaysThere) {
    const Case straight = cases().front();  // 10 m above the floor; 8 texels of the map are margin on either side
    const Compared found = compare(straight, straight, 512);
    const double texel = 2 * 10 * std::tan(.6) / (512 - 16);
    EXPECT_NEAR(found.least_texel, texel, 1e-6);
    EXPECT_NEAR(found.most_texel, texel, 1e-6);
}

TEST(BlockerAgainstMap, AQuadThreeTexelsAsideIsNoticed) {
    const Case tested = cases().front();
    Case moved = tested;
    const double texel_at_quad = 2 * 4 * std::tan(.6) / (128 - 16);  // 4 m below the light
    moved.quad.center.x += 3 * texel_at_quad;
    EXPECT_GT(compare(tested, moved, 128).apart, 50u);
}

}  // namespace
}  // namespace strata
