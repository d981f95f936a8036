// Facts about light propagation volumes as a whole, on the model: where grids lie, what reflective shadow maps give, and what a
// pixel receives (docs/algorithms/lighting.md 5.2, 5.7, 5.8, 5.10).
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "passes/indirect/lpv/injection/emission_model.h"
#include "passes/indirect/lpv/injection/injection_model.h"
#include "passes/indirect/lpv/injection/reflective_map_model.h"
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/indirect/lpv/model.h"
#include "passes/reference/image.h"
#include "passes/stage_input.h"
#include "tests/support/one_pixel.h"

namespace strata::indirect::in_double {
namespace {

using glm::dvec2, glm::dvec3, glm::dvec4, glm::uvec3, glm::vec3;
using std::numbers::pi;

/// A square mesh of Lambert surface: center +- u +- v.
void add_square(Frame& frame, const vec3& center, const vec3& u, const vec3& v, const vec3& color = vec3(1)) {
    Mesh mesh;
    mesh.positions = {center - u - v, center + u - v, center + u + v, center - u + v};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    Material material;
    material.lighting_model = LightingModel::lambert;
    material.base_color = glm::vec4(color, 1);
    material.double_sided = true;
    frame.draws.push_back({.mesh = std::uint32_t(frame.meshes.size()), .material = std::uint32_t(frame.materials.size())});
    frame.meshes.push_back(mesh);
    frame.materials.push_back(material);
}

/// With a range of so many meters that its window takes less than 1e-6 away within 4 m; its map begins at 1.5 m.
Light lamp(LightType type) {
    Light light;
    light.type = type;
    light.range = 150;
    return light;
}

dvec3 flux_of(const std::vector<VirtualLight>& lights) {
    dvec3 sum(0);
    for (const VirtualLight& light : lights) sum += light.flux;
    return sum;
}

TEST(LightVolumes, LieWhereTheFrameSays) {
    Frame frame;
    frame.view.origin = {5.3, -0.1, 2};
    frame.light_volumes = {{.half_extent = vec3(8, 4, 8), .cells = uvec3(15, 32, 32), .cascades = 2, .iterations = 7},
                           {.kind = VolumeKind::fixed_local,
                            .occlusion = VolumeOcclusion::axial,
                            .center = {1, 2, 3},
                            .half_extent = vec3(4, 2, 1),
                            .cells = uvec3(8, 8, 8)}};
    const std::vector<Grid> all = grids(frame);
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].cell_size, 1) << "local volumes first; cells are cubes as large as the longest axis needs";
    EXPECT_EQ(all[0].origin, dvec3(-3, -2, -1));
    EXPECT_EQ(all[0].occlusion, VolumeOcclusion::axial);
    const double size = 16.0 / 15;
    EXPECT_NEAR(all[1].cell_size, size, 1e-15);
    EXPECT_NEAR(all[1].origin.x, size * (4 - 7), 1e-12) << "half of 15 cells is 7, the eye in cell 4";
    EXPECT_NEAR(all[1].origin.y, size * (-1 - 16), 1e-12);
    EXPECT_NEAR(all[2].cell_size, 2 * size, 1e-12);
    EXPECT_NEAR(all[2].origin.x, 2 * size * (2 - 7), 1e-12);
    EXPECT_EQ(all[2].iterations, 7u);
    EXPECT_EQ(all[0].fade_cells, 1);
    EXPECT_EQ(all[2].fade_cells, 2);
}

TEST(LightVolumes, FillTheSameExtentWithCellsOfAnyScale) {
    Frame frame;
    frame.light_volumes = {{.half_extent = vec3(8, 4, 8), .cells = uvec3(32, 16, 32), .cascades = 2},
                           {.kind = VolumeKind::fixed_local, .half_extent = vec3(4, 2, 1), .cells = uvec3(9, 8, 8)}};
    for (const double scale : {0.5, 2.0}) {
        const std::vector<Grid> recorded = grids(frame), all = grids(frame, scale);
        ASSERT_EQ(all.size(), 3u);
        EXPECT_EQ(all[1].cell_size, scale * recorded[1].cell_size) << "cascades";
        EXPECT_EQ(dvec3(all[1].cells) * all[1].cell_size, dvec3(16, 8, 16));
        EXPECT_EQ(all[2].cell_size, 2 * all[1].cell_size);
        // 9 cells of 8 / 9 m become 18 of 4 / 9 m, or 5 of 1.6 m.
        EXPECT_EQ(all[0].cells, scale < 1 ? uvec3(18, 16, 16) : uvec3(5, 4, 4));
        EXPECT_NEAR(all[0].cell_size, scale < 1 ? 4. / 9 : 1.6, 1e-15);
        EXPECT_EQ(cell_middle(all[0], glm::ivec3(0)) + cell_middle(all[0], glm::ivec3(all[0].cells) - 1), dvec3(0));
    }
}

TEST(LightVolumes, StandStillWhileTheEyeMovesWithinACell) {
    Frame frame;
    frame.light_volumes = {{.half_extent = vec3(8), .cells = uvec3(32)}};
    frame.view.origin = {0.05, 0.1, 0.1};
    const dvec3 before = grids(frame)[0].origin;
    frame.view.origin.x = 0.45;
    EXPECT_EQ(grids(frame)[0].origin, before);
    frame.view.origin.x = 0.55;
    EXPECT_EQ(grids(frame)[0].origin, before + dvec3(0.5, 0, 0));
}

// T5.1: one face of an omni light's map sees a wall that fills it; the others see nothing.
TEST(ReflectiveMaps, OfALampHaveTheSolidAngleOfTheirFace) {
    Frame frame;
    add_square(frame, {0, 0, -2}, {3, 0, 0}, {0, 3, 0});
    Light light = lamp(LightType::omni);
    light.position = {0.1, -0.2, 0};
    const std::vector<VirtualLight> reflected = ReflectiveMaps(frame, 256, 0).of_local(light, {});
    frame.meshes[0].positions = {vec3(-1.9f, -2.2f, -2), vec3(2.1f, -2.2f, -2), vec3(2.1f, 1.8f, -2), vec3(-1.9f, 1.8f, -2)};
    const std::vector<VirtualLight> face = ReflectiveMaps(frame, 256, 0).of_local(light, {});
    EXPECT_GT(reflected.size(), 65536u);
    ASSERT_EQ(face.size(), 65536u);
    EXPECT_NEAR(flux_of(face).x, 2.0944029, 2e-6);
    EXPECT_EQ(face[0].normal, dvec3(0, 0, 1)) << "towards the light";
}

// T5.2, by the area of a floor: n^2 + 1 texels in a cell, with the largest n for which the map covers six by four cells, six
// deep, that the sun crosses at slopes of 2 / 9 and 3 / 9.
TEST(ReflectiveMaps, OfTheSunHaveTheAreaOfTheirTexels) {
    Frame frame;
    add_square(frame, {0, -1, 0}, {40, 0, 0}, {0, 0, 40}, vec3(0.5f));
    frame.sun.direction = glm::normalize(vec3(0.3f, -0.9f, 0.2f));
    frame.sun.irradiance = vec3(10, 0, -5);
    Light sun = lamp(LightType::directional);
    sun.direction = frame.sun.direction;
    sun.intensity = frame.sun.irradiance;
    const Grid grid{.cells = uvec3(2, 4, 4), .cell_size = 16. / 6, .origin = {-4, -3, -5}};
    const double texel = grid.cell_size / std::hypot(33, 1);
    const double cosine = -double(sun.direction.y) / glm::length(dvec3(sun.direction)), sent = 5 * cosine * texel * texel;
    const std::vector<VirtualLight> reflected = ReflectiveMaps(frame, 85, 0).of_directional(sun, grid);
    ASSERT_EQ(reflected.size(), 255u * 255);
    for (const VirtualLight& light : reflected) {
        ASSERT_NEAR(light.flux.x, sent, 1e-9);
        ASSERT_NEAR(light.position.y, -1, 1e-12);
    }
    EXPECT_NEAR(flux_of(reflected).x, 255 * 255 * sent, 1e-6);
    EXPECT_EQ(flux_of(reflected).y, 0);
    EXPECT_EQ(flux_of(reflected).z, 0) << "darks reflect nothing";
    const Grid whole{.cells = uvec3(64), .cell_size = 1, .origin = dvec3(-32)};
    const Field field = injected(whole, reflected, {});
    double held = 0;
    for (const dvec4& cell : field[0]) held += cell.x;
    EXPECT_NEAR(held, 255 * 255 * sent * 0.2820947918, 1e-6);
}

TEST(ReflectiveMaps, SnapToTheWorldSoThatTexelsStayWhereTheyAre) {
    Frame frame;
    add_square(frame, {0, 0, 0}, {40, 0, 0}, {0, 0, 40});
    Light sun = lamp(LightType::directional);
    sun.direction = {0, -1, 0};
    // With a cell around it the grid is 6 m by 4 m: 3^2 + 1 texels in a square meter, turned by 1 in 3, 22 by 18 of them.
    const ReflectiveMaps maps(frame, 8, 0);
    const auto here = maps.of_directional(sun, {.cells = uvec3(2, 4, 4), .cell_size = 1, .origin = dvec3(0.1)});
    const auto there = maps.of_directional(sun, {.cells = uvec3(2, 4, 4), .cell_size = 1, .origin = dvec3(0.9, 0.1, 0.6)});
    ASSERT_EQ(here.size(), 576u);
    ASSERT_EQ(there.size(), 576u);
    const dvec3 moved = there[0].position - here[0].position;
    for (const double texels : {3 * moved.z + moved.x, 3 * moved.x - moved.z}) EXPECT_NEAR(texels, std::round(texels), 1e-9);
    EXPECT_GT(glm::length(moved), .1);
    // Cells have the same texels wherever a whole number of cells takes them.
    for (const dvec3& cells : {dvec3(1, 0, 0), dvec3(0, 0, 1), dvec3(-3, 7, 2)}) {
        const auto far = maps.of_directional(sun, {.cells = uvec3(2, 4, 4), .cell_size = 1, .origin = cells + .1});
        EXPECT_NEAR(glm::distance(far[0].position, here[0].position + dvec3(cells.x, 0, cells.z)), 0, 1e-9);
    }
}

TEST(ReflectiveMaps, ReflectWhatTheLightSeesFirst) {
    Frame frame;
    add_square(frame, {0, 0, -4}, {9, 0, 0}, {0, 9, 0});
    add_square(frame, {0, 0, -2}, {5, 0, 0}, {0, 5, 0}, {0.25f, 0.5f, 0.75f});
    Light spot = lamp(LightType::square_spot);
    spot.direction = {0, 0, -1};
    spot.inner_angle = spot.outer_angle = float(pi / 4);
    const auto seen = [&] { return ReflectiveMaps(frame, 32, 0).of_local(spot, {}); };
    const dvec3 near = flux_of(seen());
    EXPECT_EQ(seen().size(), 1024u);
    EXPECT_NEAR(near.y / near.x, 2, 1e-7);
    ASSERT_FALSE(seen().empty());
    EXPECT_NEAR(seen()[0].position.z, -2, 1e-12);
    frame.materials[1].lighting_model = LightingModel::unlit;
    EXPECT_TRUE(seen().empty()) << "unlit surfaces hide what is behind and reflect nothing";
    frame.draws[1].casts_shadow = false;
    EXPECT_NEAR(flux_of(seen()).x / near.x, 4, 1e-5);
    spot.clip_planes = {{.normal = {1, 0, 0}, .distance = 0}};
    EXPECT_EQ(seen().size(), 512u);
    frame.blockers = {{.center = {0, 0, -1}, .half_u = 9, .half_v = 9}};
    spot.blockers = {0};
    EXPECT_TRUE(seen().empty()) << "stopped by the light's blocker";
}

TEST(ReflectiveMaps, OfASpotNeedNoRecordedAxis) {
    Frame frame;
    add_square(frame, {2, 0, 0}, {0, 9, 0}, {0, 0, 9});
    Light spot = lamp(LightType::round_spot);
    spot.direction = {1, 0, 0};
    spot.axis_u = {0, 1, 0};
    const auto flux = [&] { return flux_of(ReflectiveMaps(frame, 16, 0).of_local(spot, {})).x; };
    const double lit = flux();
    EXPECT_GT(lit, 0);
    spot.axis_u = {1, 0, 0};
    EXPECT_NEAR(flux(), lit, 1e-12);
}

TEST(ReflectiveMaps, LeaveToMetalsTheirMirrorImage) {
    Frame frame;
    add_square(frame, {0, 0, -2}, {9, 0, 0}, {0, 9, 0});
    Light spot = lamp(LightType::round_spot);
    spot.direction = {0, 0, -1};
    const auto flux = [&] { return flux_of(ReflectiveMaps(frame, 16, 0).of_local(spot, {})).x; };
    const double lambert = flux();
    frame.materials[0].metallic = 0.75f;
    EXPECT_EQ(flux(), lambert) << "Lambert has no metals";
    frame.materials[0].lighting_model = LightingModel::ggx;
    EXPECT_NEAR(flux(), lambert / 4, 1e-12);
}

double sent(const Light& light, const dvec3& direction) { return radiant_intensity(light, glm::normalize(direction)).x; }

TEST(Emission, IsThatOfAPointWithTheLightsArea) {
    Light light = lamp(LightType::sphere);
    light.intensity = vec3(2, -1, 0);
    light.source_radius = 0.5f;
    light.half_extent = {1.5f, 0.25f};
    light.direction = {0, 0, 1};
    light.axis_u = {1, 0, 0};
    EXPECT_NEAR(sent(light, {0, -1, 0}), 2 * pi * 0.25, 1e-12);
    EXPECT_EQ(radiant_intensity(light, {0, 1, 0}).y, 0);
    light.type = LightType::disc;
    EXPECT_NEAR(sent(light, {0, 0.6, 0.8}), 2 * pi * 0.25 * 0.8, 1e-12);
    EXPECT_EQ(sent(light, {0, 0.6, -0.8}), 0);
    light.type = LightType::rectangle;
    EXPECT_NEAR(sent(light, {0, 0.6, 0.8}), 2 * 1.5 * 0.8, 1e-12);
    EXPECT_EQ(sent(light, {0, 0, -1}), 0);
    light.type = LightType::tube;
    EXPECT_NEAR(sent(light, {0, 1, 0}), 2 * (3 + pi * 0.25), 1e-12);
    EXPECT_NEAR(sent(light, {1, 0, 0}), 2 * pi * 0.25, 1e-12) << "along the tube: its cap";
    light.type = LightType::omni;
    EXPECT_EQ(sent(light, {1, 1, 1}), 2);
}

TEST(Emission, OfSpotsFadesTowardsTheirEdges) {  // T0.2
    Light light = lamp(LightType::round_spot);
    light.direction = {0, 0, 1};
    light.inner_angle = float(pi / 6);
    light.outer_angle = float(pi / 4);
    for (const dvec2 row : {dvec2(30, 1), dvec2(35, 0.49709274), dvec2(40, 0.13754228), dvec2(44, 0.00592540), dvec2(45, 0)})
        EXPECT_NEAR(sent(light, {std::sin(row.x * pi / 180), 0, std::cos(row.x * pi / 180)}), row.y, 2e-6);
    light.type = LightType::square_spot;
    const double v = std::tan(pi / 6);
    EXPECT_EQ(sent(light, {0.89, 0.89 * v, 1}), 1) << "the last tenth fades";
    EXPECT_NEAR(sent(light, {0.95, 0, 1}), 0.5, 1e-6);
    EXPECT_NEAR(sent(light, {0, 0.95 * v, 1}), 0.5, 1e-6);
    EXPECT_EQ(sent(light, {0, 1.01 * v, 1}), 0);
    EXPECT_EQ(sent(light, {0, 0, -1}), 0);
}

TEST(LightVolumes, GiveOfAUniformFieldPiTimesItsRadianceByCells) {
    // Radiance 2 everywhere goes through a cell of half a meter as 2 W/sr per square meter of its section, 1.5 of its face in the
    // mean.
    const double size = 0.5, radiance = 2, sent = radiance * 1.5 * size * size;
    LitGrid lit{.grid = {.cells = {4, 4, 4}, .cell_size = size}};
    lit.irradiance = irradiance_cell;
    lit.light.fill(Channel(64, glm::dvec4(sent / harmonic0, 0, 0, 0)));
    const glm::dvec3 up(0, 1, 0);
    EXPECT_NEAR(irradiance(lit, {.position = {1, 1, 1}, .normal = up}).y, std::numbers::pi * radiance, 1e-9);
}

// docs/algorithms/lighting.md 5.8: q is half a cell above the surface; scale A.
TEST(LightVolumes, GiveFourTimesTheIntensityOverTheCellsArea) {
    LitGrid lit{.grid = {.cells = uvec3(8), .cell_size = 0.5, .origin = dvec3(-2)}, .light = {}};
    const dvec3 down(0, -1, 0);
    for (Channel& channel : lit.light) channel.assign(512, cosine_lobe(down) * 3.0);
    const Receiver floor{.position = {0.1, 0.2, 0.3}, .normal = {0, 1, 0}};
    EXPECT_NEAR(irradiance(lit, floor).x, 4 * 3 * 0.75 / 0.25, 1e-12) << "0.75 ahead of the lobe";
    EXPECT_EQ(irradiance(lit, {floor.position, down}), dvec3(0)) << "-0.25 behind it";
    EXPECT_NEAR(irradiance(lit, {floor.position, {1, 0, 0}}).y, 4 * 3 * 0.25 / 0.25, 1e-12);
    // Half of the taps are beyond the upper border.
    EXPECT_NEAR(irradiance(lit, {{0, 1.75, 0}, {0, 1, 0}}).x, 4 * 3 * 0.75 / 0.25 / 2, 1e-12);
}

/// Light of l0 in every cell, of sources with a normal.
LitGrid lit_by_sources_facing(const dvec3& normal) {
    LitGrid lit{.grid = {.cells = uvec3(4), .cell_size = 1, .origin = dvec3(-2)}, .light = {}, .irradiance = irradiance_cell};
    const std::vector<VirtualLight> source{{.normal = normal, .flux = dvec3(3, 2, 1)}};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto c = glm::length_t(channel);
        lit.light[channel].assign(64, dvec4(source[0].flux[c], 0, 0, 0));
        lit.facing[channel].assign(64, dvec4(by_facing(source)[0].flux[c], 0, 0, 0));
    }
    return lit;
}

TEST(LightVolumes, GiveSurfacesThatFaceAlikeNothingOfEachOthersLight) {
    const dvec3 up(0, 1, 0), right(1, 0, 0), oblique = glm::normalize(dvec3(1, 2, -2));
    const auto share = [](const dvec3& source, const dvec3& surface) {
        return share_by_facing(lit_by_sources_facing(source), {.position = dvec3(0), .normal = surface});
    };
    for (const dvec3& n : {up, -up, right, oblique}) {
        EXPECT_NEAR(share(n, n), 0, 1e-12);
        EXPECT_NEAR(share(n, -n), 2, 1e-12) << "face to face";
    }
    EXPECT_NEAR(share(up, right), 1, 1e-12);
    EXPECT_NEAR(share(up, oblique), 1 - 2. / 3, 1e-12);
    EXPECT_NEAR(share(up, dvec3(0)), 1, 1e-12) << "a particle";
    LitGrid alike = lit_by_sources_facing(up);
    alike.facing = {};
    EXPECT_EQ(share_by_facing(alike, {.normal = up}), 1);
}

TEST(LightVolumes, FadeIntoTheNextOverTheirBorder) {
    const auto even = [](double l0, double size, double fade) {
        LitGrid lit{.grid = {.cells = uvec3(8), .cell_size = size, .origin = dvec3(-4 * size), .fade_cells = fade}, .light = {}};
        lit.light.fill(Channel(512, dvec4(l0 * size * size, 0, 0, 0)));
        return lit;
    };
    const LitGrid both[] = {even(1, 1, 1), even(10, 4, 2)};
    const double one = 2 / std::sqrt(pi);  // 4 Y0
    const auto at = [&](double x) { return blended_irradiance(both, {.position = {x, 0, 0}, .normal = {0, 1, 0}}).x / one; };
    EXPECT_NEAR(at(2.9), 1, 1e-12);
    EXPECT_NEAR(at(3.25), 0.75 * 1 + 0.25 * 10, 1e-12);
    EXPECT_NEAR(at(4.5), 10, 1e-12) << "outside the first";
    EXPECT_NEAR(at(12), 5, 1e-12) << "4 m from the border of the second, which fades over 8 m, into nothing";
    EXPECT_EQ(at(17), 0);
    EXPECT_NEAR(grid_share(both[0].grid, {3.25, 0, 0}), 0.75, 1e-12);
}

/// A pixel that sees a floor under a lamp that shines on a wall; the wall's light reaches the floor.
struct LitRoom {
    Frame frame = one_pixel(1);
    LpvParams params{.iterations = 0,
                     .propagation = propagation_energy_true,
                     .faces = faces_centre,
                     .occlusion = occlusion_recorded,
                     .taps = taps_visible,
                     .map_size = 32,
                     .injection = 0.5f,
                     .cell_scale = cells_recorded,
                     .reading = 0.5f};

    LitRoom() {
        add_square(frame, {4, 0, 0}, {0, 4, 0}, {0, 0, 4});
        Light light = lamp(LightType::round_spot);
        light.position = {2, 0, 0};
        light.direction = {1, 0, 0};
        light.axis_u = {0, 0, 1};
        frame.lights = {light};
        frame.light_volumes = {{.kind = VolumeKind::fixed_local,
                                .occlusion = VolumeOcclusion::axial,
                                .half_extent = vec3(5),
                                .cells = uvec3(10),
                                .iterations = 12}};
    }
    /// Red of the pixel, whose surface is 2 m before the eye at the origin and looks towards +x, where the wall is.
    double seen() const {
        const ImageSet before = {{"surface_normal", ReferenceImage(1, 1, 1, {1, 0, 0, 2})},
                                 {"surface_color", ReferenceImage(1, 1, 1, {1, 1, 1, 1})},
                                 {"surface_material", ReferenceImage(1, 1, 1, {double(LightingModel::lambert), 0, 1, 0})}};
        return indirect_light({frame, before}, params).at("indirect").at(0, 0).x;
    }
};

TEST(LightVolumes, LightAPixelByWhatAWallReflects) {
    LitRoom room;
    const double lit = room.seen();
    EXPECT_GT(lit, 0);
    room.frame.lights[0].intensity *= 2;
    EXPECT_NEAR(room.seen() / lit, 2, 1e-12);
    room.frame.lights[0].intensity = vec3(-1);
    EXPECT_EQ(room.seen(), 0) << "darks reflect nothing";
}

TEST(LightVolumes, StayBehindAClosedWallAndComeThroughItsDoor) {
    LitRoom room;
    const double open = room.seen();
    room.frame.blockers = {{.center = {1.25, 0, 0}, .u = {0, 1, 0}, .v = {0, 0, 1}, .half_u = 9, .half_v = 9}};
    EXPECT_EQ(room.seen(), 0);
    room.params.occlusion = occlusion_none;
    EXPECT_EQ(room.seen(), open);
    room.params.occlusion = occlusion_recorded;
    room.frame.portals = {{.center = {1.25, 0, 0}, .u = {0, 1, 0}, .v = {0, 0, 1}, .half_u = 1, .half_v = 1}};
    EXPECT_GT(room.seen(), 0);
    EXPECT_LT(room.seen(), open);
    room.frame.portals.clear();
    room.frame.light_volumes[0].occlusion = VolumeOcclusion::none;
    EXPECT_EQ(room.seen(), open);
    room.params.occlusion = occlusion_axial;
    EXPECT_EQ(room.seen(), 0);
}

TEST(LightVolumes, AreReadThroughVisibleTapsIfThatIsChosen) {
    LitRoom room;
    // The pixel's taps are at x = 0.5.
    room.frame.blockers = {{.center = {0.3, 0, 2}, .u = {0, 1, 0}, .v = {0, 0, 1}, .half_u = 1.5, .half_v = 1.5}};
    EXPECT_EQ(room.seen(), 0);
    room.params.taps = taps_all;
    EXPECT_GT(room.seen(), 0);
}

TEST(LightVolumes, ReachAsFarAsTheyAreIterated) {
    LitRoom room;
    room.params.propagation = propagation_linear;
    const double recorded = room.seen();
    room.params.iterations = 12;
    EXPECT_EQ(room.seen(), recorded);
    room.params.iterations = 1;
    EXPECT_EQ(room.seen(), 0);
}

TEST(LightVolumes, TakeWhatTheSunGives) {
    LitRoom room;
    room.frame.lights.clear();
    EXPECT_EQ(room.seen(), 0);
    room.frame.sun.direction = {1, 0, 0};
    room.frame.sun.irradiance = vec3(2);
    const double lit = room.seen();
    EXPECT_GT(lit, 0);
    room.frame.sun.irradiance = vec3(1);
    EXPECT_NEAR(room.seen(), lit / 2, 1e-12);
    add_square(room.frame, {-50, 0, 0}, {0, 9, 0}, {0, 0, 9});
    EXPECT_EQ(room.seen(), 0) << "in the shadow of what is far before the volume";
}

TEST(LightVolumes, MoveWithTheWorld) {
    LitRoom room;
    const double lit = room.seen();
    // The world turned by a quarter around y and moved, and the eye with it.
    const dvec3 moved(100, -20, 1000);
    LitRoom turned;
    const glm::dmat3 turn({0, 0, 1}, {0, 1, 0}, {-1, 0, 0});
    for (vec3& p : turned.frame.meshes[0].positions) p = vec3(turn * dvec3(p));
    turned.frame.draws[0].to_world[3] = dvec4(moved, 1);
    turned.frame.light_volumes[0].center = turned.frame.view.origin = moved;
    turned.frame.lights[0].position = moved + turn * turned.frame.lights[0].position;
    turned.frame.lights[0].direction = vec3(turn * dvec3(turned.frame.lights[0].direction));
    turned.frame.lights[0].axis_u = vec3(turn * dvec3(turned.frame.lights[0].axis_u));
    turned.frame.view.to_view = glm::transpose(turn);
    EXPECT_NEAR(turned.seen() / lit, 1, 1e-12);
}

TEST(LightVolumes, GiveNothingWhereThereIsNoSurface) {
    const LitRoom room;
    const ImageSet before = {{"surface_normal", ReferenceImage(2, 1, 2)},
                             {"surface_color", ReferenceImage(2, 1, 2)},
                             {"surface_material", ReferenceImage(2, 1, 2)}};
    const ReferenceImage indirect = indirect_light({room.frame, before}, room.params).at("indirect");
    EXPECT_EQ(indirect.layers, 2u);
    for (const dvec4& texel : indirect.texels) EXPECT_EQ(texel, dvec4(0));
}

}  // namespace
}  // namespace strata::indirect::in_double
