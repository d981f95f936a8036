// The part of a shadow map that is looked up: against places of surfaces, projected one by one.
#include "passes/scene/read_part.h"

#include <gtest/gtest.h>

#include <random>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "passes/scene/scene_facts.h"
#include "tests/4_references/squares_in_view.h"

namespace strata {
namespace {

Light spot_above(const glm::vec3& place, float range) {
    return {.type = LightType::round_spot,
            .position = place,
            .direction = {0, -1, 0},
            .axis_u = {1, 0, 0},
            .range = range,
            .outer_angle = 0.8f,
            .shadow = {.casts = true, .map_size = 256}};
}

bool is_in_view(const glm::dvec3& place) {
    return place.z >= .1 && std::abs(place.x) <= place.z / 2 && std::abs(place.y) <= place.z / 2;
}

/// Texels of a map, nothing beside it.
std::optional<glm::dvec2> texel_at(const ShadowView& map, const glm::dvec3& place) {
    const glm::dvec4 at = map.view_to_map * glm::dvec4(place, 1);
    const glm::dvec2 uv = glm::dvec2(at) / at.w;
    if (!(at.w > 0) || uv.x < 0 || uv.y < 0 || uv.x >= 1 || uv.y >= 1) return {};
    return uv * double(map.size);
}

bool holds(const MapPart& part, const glm::dvec2& texel) {
    return texel.x >= part.columns.first && texel.x <= part.columns.first + part.columns.count && texel.y >= part.rows.first &&
           texel.y <= part.rows.first + part.rows.count;
}

struct Looked {
    std::size_t places = 0, outside = 0, maps = 0, partial = 0;
};

/// Random places on the squares that the view shows and the light reaches.
void look(const Frame& frame, std::mt19937& random, Looked& looked) {
    const SceneFacts facts(frame);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const ShadowView& map : facts.shadow_views(Allocation::own)) {
        const Light& light = facts.lights()[map.light];
        const bool is_sun = frame.lights.empty();
        std::optional<BoundingSphere> reach;
        if (!is_sun) reach = BoundingSphere{glm::dvec3(light.position), double(light.range)};
        const auto part = read_part(facts.readers(), map, reach, 0);
        ++looked.maps;
        looked.partial += !part || part->columns.count < map.size || part->rows.count < map.size;
        for (const Draw& draw : frame.draws)
            for (int i = 0; i < 200; ++i) {
                const double half = double(frame.meshes[draw.mesh].positions[2].x);
                const glm::dvec3 place = glm::dvec3(draw.to_world[3]) + half * glm::dvec3(unit(random), 0, unit(random));
                const bool is_read = is_sun ? place.z >= map.read_from && place.z <= map.range_end
                                            : glm::distance(place, glm::dvec3(light.position)) <= double(light.range);
                const auto texel = is_in_view(place) && is_read ? texel_at(map, place) : std::nullopt;
                if (!texel) continue;
                ++looked.places;
                looked.outside += !part || !holds(*part, *texel);
            }
    }
}

TEST(ReadPart, HoldsEveryPlaceThatTheViewShowsAndTheLightReaches) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    Looked looked;
    for (int turn = 0; turn < 60; ++turn) {
        Frame frame = empty_view();
        for (int i = 0; i < 4; ++i)
            add_square(frame, {4 * unit(random), 2 * unit(random), 6 + 5 * unit(random)}, float(1.2 + unit(random)));
        if (turn % 2 == 0) {
            frame.lights.push_back(spot_above(glm::vec3(3 * unit(random), 3, 6 + 4 * unit(random)), 8));
            frame.lights.push_back(frame.lights[0]);
            frame.lights[1].type = LightType::omni;
        } else {
            frame.sun.direction = glm::normalize(glm::vec3(unit(random), -1, unit(random)));
            frame.sun.irradiance = {1, 1, 1};
            frame.sun.cascades = 3;
            frame.sun.shadow_distance = 15;
            frame.sun.shadow = {.casts = true, .map_size = 256};
        }
        look(frame, random, looked);
    }
    EXPECT_EQ(looked.outside, 0u);
    EXPECT_GT(looked.places, 5'000u);
    EXPECT_GT(looked.partial, looked.maps / 2);
}

std::optional<MapPart> part_of(const Frame& frame, std::uint32_t margin) {
    const SceneFacts facts(frame);
    const BoundingSphere reach{glm::dvec3(frame.lights[0].position), double(frame.lights[0].range)};
    return read_part(facts.readers(), facts.shadow_views(Allocation::own).front(), reach, margin);
}

TEST(ReadPart, IsAsSmallAsASixteenthAndGrowsByTheMargin) {
    Frame frame = empty_view();
    frame.lights.push_back(spot_above({0, 3, 8}, 6));
    EXPECT_FALSE(part_of(frame, 0)) << "no surface";
    add_square(frame, {.1, 0, 8.1}, .01f);
    const auto small = part_of(frame, 0);
    ASSERT_TRUE(small);
    EXPECT_LE(small->columns.count, 32u);
    EXPECT_LE(small->rows.count, 32u);
    const auto grown = part_of(frame, 5);
    EXPECT_EQ(grown->columns.first, small->columns.first - 5);
    EXPECT_EQ(grown->columns.count, small->columns.count + 10);
    EXPECT_EQ(grown->rows.count, small->rows.count + 10);
    const auto all = part_of(frame, 1000);
    EXPECT_EQ(*all, (MapPart{{0, 256}, {0, 256}}));
    add_square(frame, {0, 20, 8}, 1);
    EXPECT_EQ(part_of(frame, 0), small) << "beside the image";
    add_square(frame, {1, -1, 8}, .01f);
    EXPECT_GT(part_of(frame, 0)->columns.count + part_of(frame, 0)->rows.count, small->columns.count + small->rows.count);
    frame.view.samples = 4;
    EXPECT_EQ(*part_of(frame, 0), (MapPart{{0, 256}, {0, 256}})) << "places of edges may lie anywhere";
}

}  // namespace
}  // namespace strata
