#include "passes/indirect/lpv/injection/injection.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/culling/draw_command.shared.h"
#include "passes/indirect/lpv/kept/kept.shared.h"
#include "passes/indirect/lpv/volumes.h"
#include "passes/scene/scene_facts.h"

namespace strata::indirect {
namespace {

/// A light's maps, and the grids that they are injected into.
struct Injected {
    std::uint32_t light = 0;
    LightMaps maps;
    std::vector<DeviceGrid*> grids;

    std::uint32_t texels() const { return maps.size * maps.size * static_cast<std::uint32_t>(maps.views.size()); }
};

/// Has the maps hold what one of the grids may take; `bias`: cells before a surface at which it takes light.
LightMaps taken_by(LightMaps maps, std::span<DeviceGrid* const> grids, float bias) {
    for (MapPush& view : maps.views) {
        view.low = glm::vec3(std::numeric_limits<float>::max());
        view.high = -view.low;
        for (const DeviceGrid* grid : grids) {
            const GridPlace& place = grid->lit_place;
            const glm::vec3 around((bias + .01f) * place.cell + 1e-3f);  // with what moves light across borders, and rounding
            view.low = glm::min(view.low, place.origin - around);
            view.high = glm::max(view.high, place.origin + glm::vec3(place.cells) * place.cell + around);
        }
    }
    return maps;
}

std::vector<Injected> injected_lights(const FrameImages& frame, const LpvParams& params, std::vector<DeviceGrid>& grids) {
    if (grids.empty()) return {};
    const std::vector<LightGrid> all = light_grids(*frame.recorded, cell_scale(params));  // also those that nobody reads
    const MapTexels texels = map_texels(params);
    const View& eye = grids.front().eye.view;
    const std::span<const Light> lights = frame.facts->lights();
    std::vector<Injected> injected;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        std::vector<DeviceGrid*> reached;
        for (DeviceGrid& grid : grids)
            if (injects(lights[i], grid.grid)) reached.push_back(&grid);
        if (reached.empty()) continue;
        if (!has_range(lights[i].type)) {
            for (DeviceGrid* const grid : reached)
                injected.push_back(
                    {i,
                     taken_by(maps_over(*frame.facts, eye, lights[i], grid->grid, texels), std::span(&grid, 1), params.injection),
                     {grid}});
            continue;
        }
        std::vector<const LightGrid*> lit;
        std::ranges::transform(reached, std::back_inserter(lit), [](const DeviceGrid* grid) { return &grid->grid; });
        LightMaps maps =
            taken_by(maps_around(eye, lights[i], lit, texels_a_side(lights[i], all, texels)), reached, params.injection);
        if (!maps.views.empty()) injected.push_back({i, std::move(maps), std::move(reached)});
    }
    return injected;
}

/// Groups over the texels of each light's maps, for each of its grids in turn: none for grids that are not lit anew.
Buffer gates_of_maps(Graph& graph, std::span<const Injected> all) {
    std::vector<MapGate> of;
    for (const Injected& injected : all)
        for (const DeviceGrid* const grid : injected.grids)
            of.push_back({.groups = (injected.texels() + injecting_group - 1) / injecting_group, .grid = grid->number});
    Buffer gates = graph.create("gates of lights' maps", of.size() * sizeof(uvec3));
    const auto count = static_cast<std::uint32_t>(of.size());
    for (std::uint32_t first = 0; first < count; first += map_gates_per_push) {
        MapGatesPush push{.first = first, .count = std::min(map_gates_per_push, count - first), .of = {}};
        std::copy_n(of.begin() + first, push.count, push.of);
        graph.compute("indirect/lpv/kept/map_gates.comp")
            .loads("Starting", all.front().grids.front()->starting)
            .stores("Gates", gates)
            .push(push)
            .groups({1, 1, 1});
    }
    return gates;
}

/// Draw commands of all casters for each of a light's maps in turn, without instances where it need not draw them.
DrawList casters_of_maps(Graph& graph, const FrameImages& frame, const Injected& injected) {
    const DeviceGrid& grid = *injected.grids.front();
    DrawList casters = frame.casters;
    std::uint32_t bits = 0;
    for (const DeviceGrid* of : injected.grids) bits |= starting_bit(of->number);
    const LightMaps& maps = injected.maps;
    casters.commands =
        graph.create("commands of casters in a light's maps", maps.views.size() * casters.count * sizeof(DrawCommand));
    casters.first = 0;
    for (std::uint32_t view = 0; view < maps.views.size() && casters.count > 0; ++view) {
        const auto [columns, rows] = maps.parts[view];
        const auto clip = [&](std::uint32_t column, std::uint32_t row) {
            return glm::vec2(glm::dvec2(column, row) * 2. / double(maps.size) - 1.);
        };
        graph.compute("indirect/lpv/injection/casters.comp")
            .loads("AllCommands", frame.casters.commands)
            .loads("Starting", grid.gates ? grid.starting : grid.sums)
            .stores("Commands", casters.commands)
            .fixes("is_gated", grid.gates ? 1u : 0u)
            .takes_first(grid.eye.records)
            .push(LitCastersPush{.casters = {.to_clip = maps.views[view].to_clip,
                                             .low = clip(columns.first, rows.first),
                                             .high = clip(columns.first + columns.count, rows.first + rows.count),
                                             .light = maps.light,
                                             .range = maps.range,
                                             .first = frame.casters.first,
                                             .count = casters.count,
                                             .to = view * casters.count},
                                 .grids = bits})
            .over({casters.count});
    }
    return casters;
}

/// `gate`: of the light's first grid, those of the others follow; `gates` may be none.
void inject(Graph& graph, const FrameImages& frame, const LpvParams& params, const Injected& injected, const Buffer& gates,
            std::uint64_t gate) {
    const LightMaps& maps = injected.maps;
    const DrawList casters = casters_of_maps(graph, frame, injected);
    const MapImages images = draw_maps(graph, frame, maps, injected.grids.front()->eye, casters);
    for (DeviceGrid* const grid : injected.grids) {
        ComputeStep step = fix_blockers(graph.compute("indirect/lpv/injection/inject.comp"), frame)
                               .samples("position", images.position)
                               .samples("normal", images.normal)
                               .samples("albedo", images.albedo)
                               .updates("Sums", grid->sums)
                               .fixes("guards", grid->has_links ? 1u : 0u)
                               .fixes("channels", grid->channels)
                               .fixes("light_features", frame.facts->light_features())
                               .takes_first(grid->eye.records)
                               .push(InjectPush{.grid = grid->lit_place,
                                                .light = injected.light,
                                                .slopes = maps.slopes,
                                                .texel_area = maps.texel_area,
                                                .fixed_one = float(grid->fixed_one),
                                                .bias = params.injection});
        gates ? step.indirect(gates, gate++ * sizeof(uvec3)) : step.over({injected.texels()});
    }
}

void clear_sums(Graph& graph, DeviceGrid& grid) {
    if (!grid.gates) return graph.clear(grid.sums, 0);
    gated(graph.compute("indirect/lpv/kept/clear_sums.comp")
              .stores("Sums", grid.sums)
              .fixes("channels", grid.channels)
              .push(grid.place),
          grid, gate_cells, grid.threads());
}

}  // namespace

double fixed_one(const SceneFacts& facts, const LightGrid& grid) {
    double most = 0;
    for (const Light& light : facts.lights())
        if (injects(light, grid)) most += most_flux(light, grid);
    const double lobe = std::sqrt(1 / (3 * std::numbers::pi));  // the largest coefficient of a watt
    return std::exp2(std::clamp(std::floor(std::log2(0x1p30 / (most * lobe))), -100., 100.));
}

void inject_lights(Graph& graph, const FrameImages& frame, const LpvParams& params, std::vector<DeviceGrid>& grids) {
    for (DeviceGrid& grid : grids) clear_sums(graph, grid);
    const std::vector<Injected> all = injected_lights(frame, params, grids);
    const bool is_kept = !all.empty() && grids.front().gates;
    const Buffer gates = is_kept ? gates_of_maps(graph, all) : Buffer();
    std::uint64_t gate = 0;
    for (const Injected& injected : all) {
        inject(graph, frame, params, injected, gates, gate);
        gate += injected.grids.size();
    }
}

}  // namespace strata::indirect
