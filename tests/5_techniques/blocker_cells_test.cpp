// The tiles of tests/4_references/blocker_cells_test.cpp on the device: its test of a point is the CPU's bit for bit, its classes
// are the CPU's, and they never contradict its test of a point. And transparent surfaces, which are lit without tiles.
#include <string_view>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/support/agreement.h"
#include "tests/support/blocker_cases.h"
#include "tests/support/session.h"
#include "tests/support/test_frame.h"

namespace strata {
namespace {

using lighting::Reach;

/// What the device found of a case: classes by place, two bits each, and a bit per point: lit, lit as tested after the classes.
struct Found {
    std::uint32_t blockers, portals;
    std::uint32_t lit[2], lit_in_tile[2];
};

constexpr std::string_view shader = R"(
    #include "passes/lighting/blocker_cells.glsl"
    struct Found { uint blockers, portals, lit[2], lit_in_tile[2]; };
    layout(local_size_x = 64) in;
    layout(set = 0, binding = 0, scalar) readonly buffer Cells { Cell cells[]; };
    layout(set = 0, binding = 1, scalar) readonly buffer Points { vec3 points[]; };
    layout(set = 0, binding = 2, scalar) writeonly buffer Results { Found found[]; };
    layout(constant_id = 0) const uint points_per_case = 1u;

    // docs/algorithms/lighting.md 2.4, P2 to P5, for one light; x blockers and y portals left to test, z: the light is killed.
    uvec3 left_to_test(LightRecord light, Cell cell, inout Found f) {
        uint open = 0u;
        uvec3 left = uvec3(0u);
        for (uint k = 0u; k < light.portals; ++k) {
            const uint c = classify_rectangle(rectangle_of_portal(light, k), light_point(light), cell);
            f.portals |= c << (2u * k);
            if (c == class_full) open |= 1u << k;
            if (c == class_partial) left.y |= 1u << k;
        }
        for (uint b = 0u; b < light.blockers; ++b) {
            const uint c = classify_rectangle(rectangle_of_blocker(light, b), light_point(light), cell);
            const uint holes = light_blockers[light.first_blocker + b].portals;
            f.blockers |= c << (2u * b);
            if ((holes & open) != 0u || c == class_none) continue;
            if (c == class_full && (holes & left.y) == 0u) left.z = 1u;
            left.x |= 1u << b;
        }
        return left;
    }

    void main() {
        const uint at = gl_GlobalInvocationID.x;
        if (at >= lights.length()) return;
        const LightRecord light = lights[at];
        Found f = Found(0u, 0u, uint[2](0u, 0u), uint[2](0u, 0u));
        const uvec3 left = left_to_test(light, cells[at], f);
        for (uint k = 0u; k < points_per_case; ++k) {
            const vec3 p = points[at * points_per_case + k];
            const uint bit = 1u << (k & 31u);
            if (blockers_pass(light, p, low_bits(light.blockers), low_bits(light.portals))) f.lit[k >> 5] |= bit;
            if (left.z == 0u && blockers_pass(light, p, left.x, left.y)) f.lit_in_tile[k >> 5] |= bit;
        }
        found[at] = f;
    })";

std::vector<Found> on_device(const BlockerCases& cases) {
    TestFrame frame;
    frame.shader("blocker_cells.comp", shader);
    Graph& graph = frame.graph;
    const auto count = static_cast<std::uint32_t>(cases.lights.size());
    Buffer found = graph.create("found", count * sizeof(Found));
    graph.compute("blocker_cells.comp")
        .loads("Lights", import_values(graph, "lights", ImportId{0xb10c0}, cases.lights))
        .loads("Blockers", import_values(graph, "blockers", ImportId{0xb10c1}, cases.blockers))
        .loads("LightBlockers", import_values(graph, "light blockers", ImportId{0xb10c2}, cases.light_blockers))
        .loads("BlockerPortals", import_values(graph, "blocker portals", ImportId{0xb10c3}, cases.portals))
        .loads("Cells", import_values(graph, "cells", ImportId{0xb10c4}, cases.cells))
        .loads("Points", import_values(graph, "points", ImportId{0xb10c5}, cases.points))
        .stores("Results", found)
        .fixes("points_per_case", static_cast<std::uint32_t>(points_per_case))
        .over({count, 1});
    graph.keep(found);
    return values_of<Found>(frame.run().buffers.at(found.id));
}

std::uint32_t packed(const std::vector<Reach>& classes) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < classes.size(); ++i) bits |= static_cast<std::uint32_t>(classes[i]) << (2 * i);
    return bits;
}

TEST(BlockerCellsOnDevice, AreThoseOfTheCpuAndContradictNoPoint) {  // docs/algorithms/lighting.md T2.0
    constexpr std::size_t count = 20000;
    const BlockerCases cases = blocker_cases(count, 20);
    const std::vector<Found> found = on_device(cases);
    ASSERT_EQ(found.size(), count);
    std::size_t other_classes = 0, dark = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const LightRecord& light = cases.lights[i];
        const CaseClasses expected = classes(cases, i);
        other_classes += found[i].blockers != packed(expected.blockers) || found[i].portals != packed(expected.portals) ? 1 : 0;
        for (std::size_t k = 0; k < points_per_case; ++k) {
            const glm::vec3& p = cases.points[i * points_per_case + k];
            const bool lit = blockers_pass(cases, light, p, {low_bits(light.blockers), low_bits(light.portals)});
            ASSERT_EQ((found[i].lit[k / 32] >> (k % 32) & 1u) != 0, lit) << "case " << i << " point " << k;
            dark += lit ? 0 : 1;
        }
        ASSERT_EQ(found[i].lit[0], found[i].lit_in_tile[0]) << "case " << i;
        ASSERT_EQ(found[i].lit[1], found[i].lit_in_tile[1]) << "case " << i;
    }
    EXPECT_GT(dark, count * points_per_case / 8);
    // A device may round a square root otherwise, and a class hangs on it where a corner lies within 1e-7 of a margin.
    EXPECT_LE(other_classes, count / 2000);
}

// docs/algorithms/lighting.md 2.8; that they matter there: 4_references.
TEST(BlockersOnDevice, HoldLightOffTransparentSurfacesAsTheModelSays) {
    Request request = on_scenario("blocker_rooms");
    const Technique& technique = *must(find_technique("transparency/sorted_lists"));
    request.choices = chosen({std::string(technique.name)});
    const Accuracy accuracy = must(session_of_scenarios().judge(request, Stage::transparency, Against::model));
    expect_within_tolerance(accuracy, technique, request, "blocker_rooms");
    EXPECT_GT(accuracy.compared, 1000u);
}

}  // namespace
}  // namespace strata
