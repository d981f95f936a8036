#include "passes/indirect/lpv/injection/injection.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>

#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/indirect/lpv/injection/maps.h"
#include "passes/indirect/lpv/kept/gated_casters.h"
#include "passes/scene/scene_facts.h"

namespace strata::indirect {
namespace {

void inject(Graph& graph, GatedCasters& casters, const LpvParams& params, std::uint32_t light, const LightMaps& maps,
            std::span<DeviceGrid* const> grids) {
    const FrameImages& frame = casters.frame();
    const MapImages images = draw_maps(graph, casters.seen_by(grids), maps);
    for (DeviceGrid* const grid : grids) {
        const auto views = static_cast<std::uint32_t>(maps.views.size());
        gated(fix_blockers(graph.compute("indirect/lpv/injection/inject.comp"), frame)
                  .samples("position", images.position)
                  .samples("normal", images.normal)
                  .samples("albedo", images.albedo)
                  .updates("Sums", grid->sums)
                  .fixes("guards", grid->has_links ? 1u : 0u)
                  .fixes("channels", grid->channels)
                  .fixes("light_features", frame.facts->light_features())
                  .push(InjectPush{.grid = grid->place,
                                   .light = light,
                                   .slopes = maps.slopes,
                                   .texel_area = maps.texel_area,
                                   .fixed_one = float(grid->fixed_one),
                                   .bias = params.injection}),
              *grid, views == 1 ? gate_one_map : gate_six_maps, {maps.size, maps.size, views});
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
    const std::span<const Light> lights = frame.facts->lights();
    GatedCasters casters(graph, frame);
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        std::vector<DeviceGrid*> reached;
        for (DeviceGrid& grid : grids)
            if (injects(lights[i], grid.grid)) reached.push_back(&grid);
        if (has_range(lights[i].type)) {
            std::vector<const LightGrid*> lit;
            std::ranges::transform(reached, std::back_inserter(lit), [](const DeviceGrid* grid) { return &grid->grid; });
            const LightMaps maps = maps_around(*frame.facts, lights[i], lit, params.map_size);
            if (!maps.views.empty()) inject(graph, casters, params, i, maps, reached);
            continue;
        }
        for (DeviceGrid* const grid : reached)
            inject(graph, casters, params, i, maps_over(*frame.facts, lights[i], grid->grid, params.map_size), {&grid, 1});
    }
}

}  // namespace strata::indirect
