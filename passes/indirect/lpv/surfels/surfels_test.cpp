// Facts about surfaces in pieces and what they stop and reflect, on the model.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "passes/indirect/lpv/injection/bounce_model.h"
#include "passes/indirect/lpv/model.h"
#include "passes/indirect/lpv/occlusion/fuzzy_model.h"
#include "tests/support/one_pixel.h"

namespace strata::indirect::in_double {
namespace {

using glm::dvec3, glm::uvec3, glm::vec3;
using std::numbers::pi;

/// Faces along +cross(u, v), without normals of their own.
void add_square(Frame& frame, const vec3& center, const vec3& u, const vec3& v, float albedo = .5f) {
    Mesh mesh;
    mesh.positions = {center - u - v, center + u - v, center + u + v, center - u + v};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    Material material;
    material.lighting_model = LightingModel::lambert;
    material.base_color = glm::vec4(vec3(albedo), 1);
    frame.draws.push_back({.mesh = std::uint32_t(frame.meshes.size()), .material = std::uint32_t(frame.materials.size())});
    frame.meshes.push_back(mesh);
    frame.materials.push_back(material);
}

/// Room for 16 x 16 x 16 cells of a meter.
const Grid room{.cells = uvec3(16), .cell_size = 1, .origin = dvec3(0)};

TEST(Surfels, OfASurfaceHaveItsAreaWhicheverWayItFaces) {
    for (const vec3 normal : {vec3(0, 0, 1), vec3(1, 1, 0), vec3(1, 2, 3), vec3(-5, 1, .1f)}) {
        Frame frame = one_pixel(1);
        const vec3 u = 3.f * glm::normalize(glm::cross(normal, vec3(.3f, -.2f, 1))), v = glm::cross(glm::normalize(normal), u);
        add_square(frame, vec3(8.1f, 7.9f, 8.3f), u, v);
        double area = 0;
        for (const Surfel& surfel : surfels(frame, room)) {
            area += surfel.area;
            EXPECT_GT(glm::dot(surfel.normal, dvec3(glm::normalize(normal))), 1 - 1e-6);
        }
        EXPECT_NEAR(area, 36, .5);  // a tenth of the texels along its edge
    }
}

TEST(Surfels, AreOfAllSurfacesInARowOnBothSidesWhereMaterialsSaySo) {
    Frame frame = one_pixel(1);
    for (const float z : {3.f, 5.f, 5.5f}) add_square(frame, vec3(8, 8, z), {2, 0, 0}, {0, 2, 0});
    frame.materials[1].double_sided = true;
    LitGrid lit{.grid = room};
    for (Channel& channel : lit.light) channel.assign(cell_count(room), glm::dvec4(1, 0, 0, 0));
    const std::vector<Surfel> all = surfels(frame, room);
    EXPECT_EQ(all.size(), 3 * 16 * 16u);
    EXPECT_EQ(reflected(all, lit).size(), 4 * 16 * 16u);
}

/// The x axis is across the wall, which is twice as wide as the room and lies between cells 7 and 8.
Links behind_a_wall(const std::vector<float>& at, bool both_ways = false) {
    Frame frame = one_pixel(1);
    for (const float x : at) {
        add_square(frame, {x, 8, 8}, {0, 16, 0}, {0, 0, 16});
        if (both_ways) add_square(frame, {x + .05f, 8, 8}, {0, 0, 16}, {0, 16, 0});
    }
    return with_surfels(room, {.cells = room.cells}, surfels(frame, room));
}
double open_across(const Links& links, std::uint32_t x) { return links.open[cell_index(room.cells, {x, 8, 8})].x; }

// docs/algorithms/lighting.md 5.5, "Limit".
TEST(FuzzyOcclusion, LetsAQuarterThroughAFullyCoveredLink) {
    const Links wall = behind_a_wall({8});
    for (std::uint32_t y = 0; y < 16; ++y)
        for (std::uint32_t z = 0; z < 16; ++z) EXPECT_NEAR(wall.open[cell_index(room.cells, {7, y, z})].x, .25, 1e-12);
    EXPECT_EQ(open_across(wall, 6), 1);
    EXPECT_EQ(open_across(wall, 8), 1);
    EXPECT_NEAR(wall.open[cell_index(room.cells, {7, 8, 8})].y, 1 - .125, 1e-12) << "light that passes along the wall, too";
}

TEST(FuzzyOcclusion, CountsAThinWallsTwoSidesOnceAndTwoWallsTwice) {
    EXPECT_NEAR(open_across(behind_a_wall({8}, true), 7), .25, 1e-12);
    EXPECT_EQ(open_across(behind_a_wall({8, 8.2f}), 7), 0);
}

TEST(FuzzyOcclusion, PutsAWallAnywhereIntoOneLayerOfLinks) {
    for (const float x : {7.6f, 7.999f, 8.3f, 8.4999f}) {
        const Links wall = behind_a_wall({x});
        EXPECT_NEAR(open_across(wall, 6) * open_across(wall, 7) * open_across(wall, 8), .25, 1e-12) << x;
    }
}

// T5.12, with the transmission that surfels give.
TEST(FuzzyOcclusion, LeaksBehindAWallAsPublished) {
    const auto dark_share = [](const Links& links) {
        Channel source(cell_count(room));
        source[cell_index(room.cells, {4, 8, 8})].x = 1;
        const Channel sum = propagated(links, source, {.propagation = propagation_linear}, 32);
        double dark = 0, lit = 0;
        for (std::uint32_t z = 0; z < 16; ++z)
            for (std::uint32_t y = 0; y < 16; ++y)
                for (std::uint32_t x = 0; x < 16; ++x) (x < 8 ? lit : dark) += sum[cell_index(room.cells, {x, y, z})].x;
        return dark / lit;
    };
    Links wall = behind_a_wall({8});
    for (dvec3& open : wall.open) open.y = open.z = 1;
    EXPECT_NEAR(dark_share(wall), .0222, 5e-5);
    EXPECT_NEAR(dark_share({.cells = room.cells}), .1020, 5e-5);
}

/// A box 8 m wide in the middle of the room, which faces inwards.
Frame closed_box(float albedo) {
    Frame frame = one_pixel(1);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        for (const float side : {-4.f, 4.f}) {
            vec3 center(8), u(0), v(0);
            center[axis] += side;
            u[(axis + 1) % 3] = 4;
            v[(axis + 2) % 3] = side < 0 ? 4 : -4;
            add_square(frame, center, u, v, albedo);
        }
    return frame;
}

double flux_of(const std::vector<VirtualLight>& lights) {
    double sum = 0;
    for (const VirtualLight& light : lights) sum += light.flux.x;
    return sum;
}

// Where irradiance is known, walls reflect their albedo of it: a cell of l0 sends l0 / Y0 watts, and gives a wall l0 C0 / 1.5.
TEST(SecondBounce, ReflectsTheAlbedoOfWhatAWallReceives) {
    LitGrid lit{.grid = room, .light = {}, .irradiance = irradiance_cell};
    for (Channel& channel : lit.light) channel.assign(cell_count(room), glm::dvec4(3, 0, 0, 0));
    const double received = 3 * std::sqrt(pi) / 2 / 1.5, area = 6 * 64;
    for (const float albedo : {.25f, 1.f}) {
        const std::vector<Surfel> walls = surfels(closed_box(albedo), room);
        EXPECT_NEAR(flux_of(reflected(walls, lit)), albedo * received * area, .01 * albedo * received * area);
    }
    EXPECT_EQ(flux_of(reflected(surfels(closed_box(0), room), lit)), 0);
}

}  // namespace
}  // namespace strata::indirect::in_double
