#include "passes/indirect/lpv/ratios.h"

#include <cstddef>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"

namespace strata::indirect {
namespace {

/// The first volume with so many cells each way in the same extent.
template <std::uint32_t cells>
void with_cells(Frame& frame) {
    frame.light_volumes.front().cells = glm::uvec3(cells);
}

/// Lights of a hall, each shining in all directions, in a volume. The first one of the scenario is left out: it stands in a
/// column.
template <std::size_t lights>
void with_lights(Frame& frame) {
    frame.lights.erase(frame.lights.begin());
    frame.lights.resize(lights);
    for (Light& light : frame.lights) light.type = LightType::omni;
    frame.light_volumes = {
        {.kind = VolumeKind::fixed_local, .center = {0, 2.5, 0}, .half_extent = {7, 3.5f, 31}, .cells = {7, 4, 31}}};
}

constexpr FrameChange cells_16{"16^3 cells", with_cells<16>}, cells_32{"32^3 cells", with_cells<32>},
    cells_48{"48^3 cells", with_cells<48>}, cells_64{"64^3 cells", with_cells<64>}, lights_1{"1 light", with_lights<1>},
    lights_4{"4 lights", with_lights<4>}, lights_16{"16 lights", with_lights<16>}, lights_64{"64 lights", with_lights<64>};

/// A published ratio.
struct Statement {
    double ratio = 0;
    std::string_view source;
};
// Both count cells, texels and iterations, and time nothing.
constexpr Statement per_cell{8, "bytes and operations in proportion to cells, docs/algorithms/lighting.md 5.9"},
    per_texel{4, "additions in proportion to texels, docs/algorithms/lighting.md 5.9"},
    per_iteration{4, "bytes and operations in proportion to iterations, docs/algorithms/lighting.md 5.9"};

}  // namespace

std::vector<TimeRatio> lpv_ratios() {
    using Names = std::vector<std::string_view>;
    const Names stage = {}, propagation = {"/propagate"}, apply = {"/apply/"}, injection = {"/injection/map", "/inject.comp"},
                inject = {"/inject.comp"};
    const Names injected = {"injected"}, taps = {"samples", "hidden taps"}, tested = {"samples", "blocker tests"},
                relit = {"cells relit", "faces rebuilt"}, none = {};
    // Maps of fewer texels, so that 64 lights fit into a minute.
    constexpr std::string_view few_texels = "map_size=32 iterations=1";
    struct Row {
        std::string_view name, of, against, scenario;
        const Names &steps, &counters;
        FrameChange of_frame = {}, against_frame = {};
        std::optional<Statement> stated = {};
        bool of_unchanged = false;
    };
    const Row rows[] = {
        {"propagation steps: linear (closed form) / clamped", "propagation=linear", "propagation=clamped", "cornell_box",
         propagation, none},
        {"propagation steps: linear (closed form) / energy_true", "propagation=linear", "propagation=energy_true", "cornell_box",
         propagation, none},
        {"propagation steps: energy_true / clamped", "propagation=energy_true", "propagation=clamped", "cornell_box", propagation,
         none},
        {"propagation steps: face integrals / face centers", "faces=exact", "faces=centre", "cornell_box", propagation, none},
        {"propagation steps: half-float cells / float cells", "cell_storage=half", "cell_storage=float", "cornell_box",
         propagation, none},
        {"propagation steps: 64 iterations / 16 iterations",
         "iterations=64",
         "iterations=16",
         "cornell_box",
         propagation,
         none,
         {},
         {},
         per_iteration},
        {"propagation steps: axial occlusion / no occlusion", "occlusion=axial", "occlusion=none", "two_rooms", propagation,
         none},
        {"propagation steps: 32^3 cells / 16^3 cells", "", "", "cornell_box", propagation, none, cells_32, cells_16, per_cell},
        {"propagation steps: 48^3 cells / 16^3 cells", "", "", "cornell_box", propagation, none, cells_48, cells_16},
        {"propagation steps: 64^3 cells / 16^3 cells", "", "", "cornell_box", propagation, none, cells_64, cells_16},
        {"propagation steps: 64^3 cells / 32^3 cells", "", "", "cornell_box", propagation, none, cells_64, cells_32, per_cell},
        {"whole stage: 32^3 cells / 16^3 cells", "", "", "cornell_box", stage, none, cells_32, cells_16},
        {"whole stage: 48^3 cells / 16^3 cells", "", "", "cornell_box", stage, none, cells_48, cells_16},
        {"whole stage: 64^3 cells / 16^3 cells", "", "", "cornell_box", stage, none, cells_64, cells_16},
        {"whole stage: axial occlusion / no occlusion", "occlusion=axial", "occlusion=none", "two_rooms", stage, taps},
        {"apply: visible taps / all taps", "taps=visible", "taps=all", "two_rooms", apply, taps},
        {"apply: half resolution / full resolution", "apply_resolution=half", "apply_resolution=full", "two_rooms", apply, taps},
        {"apply: damping by the light behind the surface / no damping", "damping=2", "damping=0", "two_rooms", apply, tested},
        {.name = "whole stage: unchanged frame, volume kept / lit in every frame",
         .of = "relight=changed",
         .against = "relight=always",
         .scenario = "two_rooms",
         .steps = stage,
         .counters = relit,
         .of_unchanged = true},
        {"whole stage: 2 bounces / 1 bounce", "bounces=2", "bounces=1", "cornell_box", stage, none},
        {"injection: RSMs of 256^2 texels / 128^2 texels",
         "map_size=256",
         "map_size=128",
         "two_rooms",
         inject,
         injected,
         {},
         {},
         per_texel},
        {"injection: 4 lights / 1 light", few_texels, few_texels, "hall_of_lights_65", injection, injected, lights_4, lights_1},
        {"injection: 16 lights / 1 light", few_texels, few_texels, "hall_of_lights_65", injection, injected, lights_16, lights_1},
        {"injection: 64 lights / 1 light", few_texels, few_texels, "hall_of_lights_65", injection, injected, lights_64, lights_1},
    };
    std::vector<TimeRatio> ratios;
    for (const Row& row : rows)
        ratios.push_back({.name = row.name,
                          .of = row.of,
                          .against = row.against,
                          .steps = row.steps,
                          .published = row.stated ? std::optional(row.stated->ratio) : std::nullopt,
                          .source = row.stated ? row.stated->source : "",
                          .scenario = row.scenario,
                          .counters = row.counters,
                          .of_frame = row.of_frame,
                          .against_frame = row.against_frame,
                          .of_unchanged = row.of_unchanged});
    return ratios;
}

}  // namespace strata::indirect
