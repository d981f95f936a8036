// Maps of lights hold every place that reflects into a grid, at random, and are as fine as its cells ask for.
#include "passes/indirect/lpv/injection/maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "passes/scene/scene_facts.h"
#include "tests/support/random_numbers.h"

namespace strata::indirect {
namespace {

const LightGrid mapped_grid{.origin = {-2, -1, -1.5}, .cell = .5, .cells = {8, 4, 6}};

/// Cubes of all sizes around the grid, and an eye that looks along none of the world's axes.
Frame cubes(Numbers& numbers) {
    Frame frame;
    frame.view.origin = {3, 1, -4};
    frame.view.to_view = glm::transpose(
        glm::dmat3(glm::normalize(glm::dvec3(2, 0, 1)), glm::dvec3(0, 1, 0), glm::normalize(glm::dvec3(-1, 0, 2))));
    frame.materials.emplace_back();
    Mesh& cube = frame.meshes.emplace_back();
    for (unsigned i = 0; i < 8; ++i) cube.positions.emplace_back(i & 1u ? .5f : -.5f, i & 2u ? .5f : -.5f, i & 4u ? .5f : -.5f);
    for (int i = 0; i < 40; ++i) {
        Draw& draw = frame.draws.emplace_back();
        draw.to_world = glm::dmat4(double(numbers.from(.05f, 1.5f)));
        draw.to_world[3] = glm::dvec4(glm::dvec3(numbers.box(8)), 1);
    }
    return frame;
}

struct Seen {
    std::size_t view = 0;
    glm::dvec2 texel{0};
};

/// The map in which the light sees a place of the world; none: no map has it.
std::optional<Seen> seen_in(const Frame& frame, const LightMaps& maps, const glm::dvec3& world) {
    const glm::dvec3 place = frame.view.to_view * (world - frame.view.origin);
    for (std::size_t i = 0; i < maps.views.size(); ++i) {
        const glm::dvec4 clip = glm::dmat4(maps.views[i].to_clip) * glm::dvec4(place, 1);
        if (clip.w > .05 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w)
            return Seen{i, (glm::dvec2(clip) / clip.w + 1.) / 2. * double(maps.size)};
    }
    return {};
}

template <typename Lines>
bool holds(const Lines& lines, double at) {
    return at >= lines.first && at <= lines.first + lines.count;
}

TEST(LightMaps, HoldEveryPlaceOfAGrid) {
    Numbers numbers(7);
    const glm::dvec3 low = mapped_grid.origin - mapped_grid.cell, size = mapped_grid.cell * (glm::dvec3(mapped_grid.cells) + 2.);
    const LightGrid* const grids[] = {&mapped_grid};
    std::size_t cropped = 0;
    for (int scene = 0; scene < 200; ++scene) {
        const Frame frame = cubes(numbers);
        const SceneFacts facts(frame);
        const Light light{.type = LightType::omni, .position = glm::dvec3(numbers.box(scene % 2 == 0 ? 9.f : 2.f)), .range = 30};
        const LightMaps maps = maps_around(frame.view, light, grids, 128);
        for (const MapPart& part : maps.parts) cropped += part.columns.count < 128 || part.rows.count < 128 ? 1 : 0;
        const glm::dvec3 from = frame.view.to_view * (light.position - frame.view.origin);
        for (int ray = 0; ray < 50; ++ray) {
            const glm::dvec3 world = low + size * glm::dvec3(numbers.from(0, 1), numbers.from(0, 1), numbers.from(0, 1));
            const glm::dvec3 to = frame.view.to_view * (world - frame.view.origin);
            if (glm::distance(from, to) < .2) continue;
            const auto seen = seen_in(frame, maps, world);
            ASSERT_TRUE(seen) << scene << ' ' << ray;
            EXPECT_TRUE(holds(maps.parts[seen->view].columns, seen->texel.x)) << seen->texel.x;
            EXPECT_TRUE(holds(maps.parts[seen->view].rows, seen->texel.y)) << seen->texel.y;
        }
    }
    EXPECT_GT(cropped, 60u);
}

TEST(LightMaps, OfALampFarFromAGridAreASmallPartOfOneSide) {
    Numbers numbers(8);
    const Frame frame = cubes(numbers);
    const SceneFacts facts(frame);
    const LightGrid* const grids[] = {&mapped_grid};
    const LightMaps maps = maps_around(frame.view, {.type = LightType::omni, .position = {40, 0, 0}, .range = 100}, grids, 128);
    ASSERT_EQ(maps.views.size(), 1u);
    // The nearest face of the grid and a cell around it: 3 x 4 m at 37.5 m.
    EXPECT_NEAR(maps.parts[0].columns.count * maps.parts[0].rows.count, 128 * 128 * 3 * 4 / (75. * 75), 50);
}

constexpr MapTexels four_per_cell{.most = 128, .per_cell = 4};

TEST(LightMaps, HaveTexelsByTheCellsThatALightReaches) {
    LightGrid local = mapped_grid, cascade = mapped_grid;
    local.is_local = true;
    const auto texels = [&](const Light& light, const LightGrid& grid, MapTexels wanted = four_per_cell) {
        return texels_a_side(light, std::span(&grid, 1), wanted);
    };
    Light lamp{.type = LightType::omni, .position = {0, 0, 0}, .intensity = {1, 1, 1}, .range = 6};
    EXPECT_EQ(texels(lamp, cascade), 48u) << "6 m wide at 3 m, 4 in half a meter";
    // The farthest corner of the grid and a cell around it is at (2.5, 1.5, 2): 3.54 m.
    EXPECT_EQ(texels(lamp, local), 32u) << "28.3, in multiples of 8";
    EXPECT_EQ(texels(lamp, cascade, {.most = 128, .per_cell = 0}), 128u);
    EXPECT_EQ(texels(lamp, cascade, {.most = 40, .per_cell = 4}), 40u);
    lamp.range = 1;
    EXPECT_EQ(texels(lamp, cascade), 16u);
    lamp.position.x = 100;
    lamp.range = 6;
    EXPECT_EQ(texels(lamp, local), 16u) << "it does not reach the grid";
    EXPECT_EQ(texels(lamp, cascade), 48u) << "wherever the eye takes it";
    lamp.position.x = 0;
    lamp.range = std::numeric_limits<float>::infinity();
    EXPECT_EQ(texels(lamp, cascade), 128u);
    const Light spot{
        .type = LightType::round_spot, .position = {0, 0, 0}, .intensity = {1, 1, 1}, .range = 6, .outer_angle = std::atan(.5f)};
    EXPECT_EQ(texels(spot, cascade), 24u);
}

TEST(LightMaps, OfParallelLightHaveNoMoreTexelsThanCellsAskFor) {
    Numbers numbers(9);
    const Frame frame = cubes(numbers);
    const SceneFacts facts(frame);
    const Light sun{.type = LightType::directional, .direction = {0, -1, 0}, .intensity = {1, 1, 1}};
    const LightMaps fine = maps_over(facts, frame.view, sun, mapped_grid, {.most = 128, .per_cell = 0});
    const LightMaps coarse = maps_over(facts, frame.view, sun, mapped_grid, {.most = 128, .per_cell = 2});
    // 6 x 6 + 1 squares make the square of a cell.
    EXPECT_NEAR(double(coarse.texel_area), .25 / 37, 1e-9);
    EXPECT_EQ(coarse.size, 72u) << "5 m and 4 m along axes turned by 1 in 6: (6 x 5 + 4) / .5 + 1 = 69";
    EXPECT_EQ(fine.size, 384u);
    EXPECT_LT(fine.texel_area, .25f / 900);
}

}  // namespace
}  // namespace strata::indirect
