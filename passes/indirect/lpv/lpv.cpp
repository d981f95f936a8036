// Light propagation volumes: what lights reach is injected into grids and handed from cell to cell.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "passes/choice_names.h"
#include "passes/edges/plain_pixels.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/indirect/lpv/maps.h"
#include "passes/scene/scene_facts.h"
#include "passes/technique.h"

namespace strata::indirect {

ImageSet lpv_model(const StageInput&, const Settings&);

namespace {

constexpr auto propagations =
    choice_names({{propagation_linear, "linear"}, {propagation_clamped, "clamped"}, {propagation_energy_true, "energy_true"}});
constexpr auto face_rules = choice_names({{faces_centre, "centre"}, {faces_exact, "exact"}});
constexpr auto occlusions =
    choice_names({{occlusion_recorded, "recorded"}, {occlusion_none, "none"}, {occlusion_axial, "axial"}});
constexpr auto irradiances = choice_names({{irradiance_face, "face"}, {irradiance_cell, "cell"}});
constexpr auto tap_rules = choice_names({{taps_all, "all"}, {taps_visible, "visible"}});

/// A grid on the device.
struct DeviceGrid {
    LightGrid grid;
    GridPlace place;
    bool has_links = false;
    double fixed_one = 1;
    std::size_t number = 0;  ///< in the order of light_grids()
    Buffer sums, links, total;

    std::uint32_t cells() const { return grid.cells.x * grid.cells.y * grid.cells.z; }
    std::string name(const char* what) const { return fmt::format("{} {}", what, number); }
};

/// One per cell.
Extent threads(const DeviceGrid& grid) { return {grid.grid.cells.x, grid.grid.cells.y, grid.grid.cells.z}; }

/// Fixes what passes/indirect/lpv/ways.glsl declares.
ComputePass fix_blockers(ComputePass pass, const FrameImages& frame) {
    return pass.fixes("blocker_count", static_cast<std::uint32_t>(frame.recorded->blockers.size()))
        .fixes("portal_count", static_cast<std::uint32_t>(frame.recorded->portals.size()));
}

bool is_axial(const LightGrid& grid, std::uint32_t occlusion) {
    if (occlusion == occlusion_recorded) return grid.occlusion == VolumeOcclusion::axial;
    return occlusion == occlusion_axial;
}

/// 2^k such that all that lights can send is no more than 2^30 of a coefficient.
double fixed_one(const SceneFacts& facts, const LightGrid& grid) {
    double most = 0;
    for (const Light& light : facts.lights())
        if (injects(light, grid)) most += most_flux(light, grid);
    const double lobe = std::sqrt(1 / (3 * std::numbers::pi));  // the largest coefficient of a watt
    return std::exp2(std::clamp(std::floor(std::log2(0x1p30 / (most * lobe))), -100., 100.));
}

std::vector<DeviceGrid> make_grids(Graph& graph, const FrameImages& frame, const LpvParams& params) {
    std::vector<DeviceGrid> made;
    for (const LightGrid& grid : light_grids(*frame.recorded)) {
        const glm::dvec3 origin = grid.origin - frame.recorded->view.origin;
        DeviceGrid g{.grid = grid,
                     .place = {.origin = glm::vec3(origin), .cell = float(grid.cell), .cells = grid.cells},
                     .has_links = is_axial(grid, params.occlusion) && !frame.recorded->blockers.empty(),
                     .fixed_one = fixed_one(*frame.facts, grid),
                     .number = made.size()};
        g.sums = graph.create(g.name("injected light of grid"), std::uint64_t{g.cells()} * sizeof(LightCell));
        graph.clear(g.sums, 0);
        made.push_back(g);
    }
    return made;
}

void inject(Graph& graph, const FrameImages& frame, const LpvParams& params, std::uint32_t light, const LightMaps& maps,
            std::span<DeviceGrid* const> grids) {
    const MapImages images = draw_maps(graph, frame, maps, params.map_size);
    for (DeviceGrid* const grid : grids) {
        fix_blockers(graph.compute("indirect/lpv/inject.comp"), frame)
            .samples("position", images.position)
            .samples("normal", images.normal)
            .samples("albedo", images.albedo)
            .updates("Sums", grid->sums)
            .fixes("guards", grid->has_links ? 1u : 0u)
            .fixes("light_features", frame.facts->light_features())
            .push(InjectPush{.grid = grid->place,
                             .light = light,
                             .slopes = maps.slopes,
                             .texel_area = maps.texel_area,
                             .fixed_one = float(grid->fixed_one),
                             .bias = params.injection})
            .over({params.map_size, params.map_size, static_cast<std::uint32_t>(maps.views.size())});
    }
}

/// A light's maps serve all the grids that it reaches; those of parallel light are laid over each grid.
void inject_lights(Graph& graph, const FrameImages& frame, const LpvParams& params, std::vector<DeviceGrid>& grids) {
    const std::span<const Light> lights = frame.facts->lights();
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        std::vector<DeviceGrid*> reached;
        for (DeviceGrid& grid : grids)
            if (injects(lights[i], grid.grid)) reached.push_back(&grid);
        if (lights[i].type != LightType::directional) {
            if (!reached.empty()) inject(graph, frame, params, i, maps_around(*frame.recorded, lights[i]), reached);
            continue;
        }
        for (DeviceGrid* const grid : reached)
            inject(graph, frame, params, i, maps_over(*frame.facts, lights[i], grid->grid, params.map_size), {&grid, 1});
    }
}

void find_links(Graph& graph, const FrameImages& frame, DeviceGrid& grid) {
    if (!grid.has_links) return;
    grid.links = graph.create(grid.name("links of grid"), std::uint64_t{grid.cells()} * 3 * sizeof(float));
    fix_blockers(graph.compute("indirect/lpv/links.comp"), frame)
        .stores("Links", grid.links)
        .push(grid.place)
        .over({grid.grid.cells.x, grid.grid.cells.y, 3 * grid.grid.cells.z});
}

ComputePass fix_faces(ComputePass pass, const LpvParams& params) {
    return pass.fixes("propagation", params.propagation).fixes("faces", params.faces);
}

std::uint32_t iterations(const LpvParams& params, const DeviceGrid& grid) {
    return params.iterations > 0 ? params.iterations : grid.grid.iterations;
}

/// Binds what passes/indirect/lpv/links.glsl declares. Without links nothing is read of the buffer that stands for them.
ComputePass fix_links(ComputePass pass, const DeviceGrid& grid) {
    return pass.loads("Links", grid.has_links ? grid.links : grid.sums).fixes("has_links", grid.has_links ? 1u : 0u);
}

/// Finds the links, and calls look(step, light) with what the cells hold before each step and after the last.
template <typename Look>
void propagate(Graph& graph, const FrameImages& frame, const LpvParams& params, DeviceGrid& grid, const Look& look) {
    find_links(graph, frame, grid);
    const std::uint64_t bytes = std::uint64_t{grid.cells()} * sizeof(StepCell);
    Buffer now = graph.create(grid.name("light of even steps of grid"), bytes);
    Buffer next = graph.create(grid.name("light of odd steps of grid"), bytes);
    grid.total = graph.create(grid.name("light of grid"), std::uint64_t{grid.cells()} * sizeof(LightCell));
    fix_faces(graph.compute("indirect/lpv/resolve.comp"), params)
        .loads("Sums", grid.sums)
        .stores("Step", now)
        .stores("Total", grid.total)
        .push(ResolvePush{.grid = grid.place, .fixed_one = float(grid.fixed_one)})
        .over(threads(grid));
    look(0, now);
    for (std::uint32_t step = 0; step < iterations(params, grid); ++step) {
        fix_links(fix_faces(graph.compute("indirect/lpv/propagate.comp"), params), grid)
            .loads("Before", now)
            .stores("After", next)
            .updates("Total", grid.total)
            .push(grid.place)
            .over(threads(grid));
        std::swap(now, next);
        look(step + 1, now);
    }
}

/// Cells over which a grid fades at its border.
double border_cells(const LightGrid& grid) { return grid.is_local ? 1 : 2; }

/// To a step whose shader includes passes/indirect/lpv/taps.glsl.
ComputePass see_light(ComputePass pass, const FrameImages& frame, const LpvParams& params, const DeviceGrid& grid) {
    return sample_gbuffer(fix_blockers(pass, frame), frame)
        .loads("Total", grid.total)
        .fixes("asks_taps", grid.has_links && params.taps == taps_visible ? 1u : 0u)
        .push(ApplyPush{.grid = grid.place, .border = float(border_cells(grid.grid) * grid.grid.cell)});
}

std::vector<DeviceGrid> lit_grids(Graph& graph, const FrameImages& frame, const LpvParams& params) {
    std::vector<DeviceGrid> grids = make_grids(graph, frame, params);
    inject_lights(graph, frame, params, grids);
    for (DeviceGrid& grid : grids) propagate(graph, frame, params, grid, [](std::uint32_t, const Buffer&) {});
    return grids;
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.gbuffer0) return;
    const auto params = settings.as<LpvParams>();
    const std::vector<DeviceGrid> grids = lit_grids(graph, frame, params);
    frame.indirect = graph.create("indirect", {.extent = frame.extent, .format = Format::rgba16f, .layers = frame.samples});
    graph.clear(frame.indirect, {});
    // What a point takes of the first grid that holds it lies over what it takes of those after it.
    for (auto grid = grids.rbegin(); grid != grids.rend(); ++grid)
        sample_edges(see_light(graph.compute("indirect/lpv/apply.comp"), frame, params, *grid), frame)
            .updates("indirect", frame.indirect)
            .fixes("irradiance", params.irradiance)
            .over({frame.extent.width, frame.extent.height, frame.samples});
}

Image visible_taps(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<LpvParams>();
    const std::vector<DeviceGrid> grids = lit_grids(graph, frame, params);
    Image picture = graph.create("visible taps", {.extent = frame.extent, .format = Format::rgba32f});
    graph.clear(picture, {});
    for (auto grid = grids.rbegin(); grid != grids.rend(); ++grid)
        see_light(graph.compute("indirect/lpv/view.comp"), frame, params, *grid).stores("picture", picture).over(frame.extent);
    return picture;
}

Image energy_table(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<LpvParams>();
    std::vector<DeviceGrid> grids = make_grids(graph, frame, params);
    inject_lights(graph, frame, params, grids);
    const std::uint32_t rows = grids.empty() ? 1 : iterations(params, grids.front()) + 1;
    Image numbers = graph.create("energy", {.extent = {1, rows}, .format = Format::rgba32f});
    graph.clear(numbers, {});
    if (grids.empty()) return numbers;
    DeviceGrid& grid = grids.front();
    propagate(graph, frame, params, grid, [&](std::uint32_t step, const Buffer& light) {
        fix_links(fix_faces(graph.compute("indirect/lpv/energy.comp"), params), grid)
            .loads("Before", light)
            .updates("numbers", numbers)
            .push(EnergyPush{.grid = grid.place, .step = step})
            .groups({1, 1, 1});
    });
    return numbers;
}

}  // namespace

Technique lpv() {
    return {
        .stage = Stage::indirect,
        .name = "indirect/lpv",
        .title = "Light propagation volumes",
        .source =
            "Kaplanyan, Dachsbacher: Cascaded Light Propagation Volumes for Real-Time Indirect Illumination, I3D 2010; axial "
            "occlusion and visible taps: Kircher, Rendering Technology in Agents of Mayhem, GDC 2018",
        .summary =
            "Hands light on from cell to cell of a grid. Light from farther than an eighth of the iterations, in cells, is too "
            "dark; "
            "details smaller than a cell are lost.",
        .params =
            {param<&LpvParams::iterations>(
                 {.name = "iterations", .high = 64, .fallback = 0, .help = "steps of propagation; 0: as the capture says"}),
             param<&LpvParams::propagation>(
                 {.name = "propagation",
                  .high = 2,
                  .fallback = propagation_energy_true,
                  .help =
                      "negative radiance at a face: kept, clamped to 0, or clamped and scaled so that a cell sends what it holds",
                  .choices = propagations}),
             param<&LpvParams::faces>({.name = "faces",
                                       .high = 1,
                                       .fallback = faces_centre,
                                       .help = "radiance at the center of a face, or integrated over it",
                                       .choices = face_rules}),
             param<&LpvParams::occlusion>({.name = "occlusion",
                                           .high = 2,
                                           .fallback = occlusion_recorded,
                                           .help = "what stops light between cells; axial: blockers with their portals",
                                           .choices = occlusions}),
             param<&LpvParams::taps>({.name = "taps",
                                      .high = 1,
                                      .fallback = taps_visible,
                                      .help = "cells to interpolate: all, or only those that no blocker hides from the surface",
                                      .choices = tap_rules}),
             param<&LpvParams::irradiance>({.name = "irradiance",
                                            .high = 1,
                                            .fallback = irradiance_cell,
                                            .help = "how a cell's light becomes irradiance: face, as of a light at the cell's "
                                                    "face; cell, as the mean over the cell",
                                            .choices = irradiances}),
             param<&LpvParams::map_size>({.name = "map_size",
                                          .low = 16,
                                          .high = 512,
                                          .fallback = 128,
                                          .help = "resolution of reflective shadow maps, texels per side",
                                          .scale = Scale::logarithmic}),
             param<&LpvParams::injection>({.name = "injection",
                                           .high = 1,
                                           .fallback = .5,
                                           .help = "offset of injected light along the surface's normal, cells"})},
        .points = {"iterations=8", "iterations=32", "propagation=linear", "propagation=clamped", "faces=exact", "occlusion=none",
                   "taps=all", "map_size=64", "irradiance=face"},
        .counters = {counter<&LpvCounters::injected>(
                         {.name = "injected", .help = "virtual point lights injected, summed over all grids"}),
                     counter<&LpvCounters::guarded>(
                         {.name = "guarded",
                          .help = "virtual point lights injected into another cell, because a blocker hides the nearest"}),
                     counter<&LpvCounters::dropped>(
                         {.name = "dropped", .help = "virtual point lights lost, because blockers hide all cells near them"}),
                     counter<&LpvCounters::outside>({.name = "outside", .help = "virtual point lights outside of the grid"}),
                     counter<&LpvCounters::samples>({.name = "samples", .help = "samples lit by a grid"}),
                     counter<&LpvCounters::hidden_taps>(
                         {.name = "hidden taps", .help = "interpolated cells that a blocker hides, summed over samples"}),
                     counter<&LpvCounters::unfinished>(unfinished_row)},
        .counter_bytes = sizeof(LpvCounters),
        .views = {{.name = "visible taps",
                   .help = "of the eight interpolated cells, those that no blocker hides from the surface",
                   .unit = "cells",
                   .high = 8,
                   .declare = visible_taps}},
        .tables = {{.name = "energy",
                    .help = "energy of the first grid by step: held in its cells, absorbed by blockers, escaped over the border",
                    .columns = {{"step", ""}, {"held", "W"}, {"absorbed", "W"}, {"escaped", "W"}},
                    .declare = energy_table}},
        .declare = declare,
        .model = lpv_model,
        .tolerance = {.rmse = 3e-3,
                      .worst = 8e-2,
                      .because = "half floats; virtual point lights within a rounding of a cell's border fall to either side"}};
}

}  // namespace strata::indirect
