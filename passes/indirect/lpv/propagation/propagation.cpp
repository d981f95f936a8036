#include "passes/indirect/lpv/propagation/propagation.h"

#include <utility>

#include "passes/frame_images.h"
#include "passes/indirect/lpv/occlusion/fuzzy.h"

namespace strata::indirect {
namespace {

void find_links(Graph& graph, const FrameImages& frame, DeviceGrid& grid) {
    if (!grid.has_links || grid.links) return;
    grid.links = graph.create(grid.name("links of grid"), std::uint64_t{grid.cells()} * 3 * sizeof(float));
    fix_blockers(graph.compute("indirect/lpv/occlusion/links.comp"), frame)
        .stores("Links", grid.links)
        .takes_first(grid.eye.records)
        .push(grid.lit_place)
        .over({grid.grid.cells.x, grid.grid.cells.y, 3 * grid.grid.cells.z});
}

/// The brightest l0 that is injected, in fixed point: what half floats are scaled by.
Buffer brightest_sum(Graph& graph, const DeviceGrid& grid) {
    Buffer brightest = graph.create(grid.name("brightest injected light of grid"), sizeof(std::uint32_t));
    graph.clear(brightest, 0);
    gated(graph.compute("indirect/lpv/injection/brightest_sum.comp")
              .loads("Sums", grid.sums)
              .updates("Brightest", brightest)
              .fixes("channels", grid.channels)
              .push(grid.place),
          grid, gate_cells, grid.threads());
    return brightest;
}

/// Of the light that is injected the first step, and what is summed so far.
void resolve(Graph& graph, const LpvParams& params, DeviceGrid& grid, Buffer& step) {
    const Buffer brightest = grid.storage == storage_half ? brightest_sum(graph, grid) : grid.sums;
    gated(fix_faces(graph.compute("indirect/lpv/injection/resolve.comp"), params)
              .loads("Sums", grid.sums)
              .stores("After", step)
              .stores("Total", grid.total)
              .loads("Scale", grid.scale ? grid.scale : grid.sums)
              .loads("Brightest", brightest)
              .fixes("has_scale", grid.scale ? 1u : 0u)
              .fixes("shows_injected", params.self_light == self_uninjected ? 0u : 1u)
              .fixes("cell_storage", grid.storage)
              .fixes("channels", grid.channels)
              .push(ResolvePush{.grid = grid.place, .fixed_one = float(grid.fixed_one)}),
          grid, gate_cells, grid.threads());
}

}  // namespace

ComputeStep fix_faces(ComputeStep builder, const LpvParams& params) {
    return builder.fixes("propagation", params.propagation).fixes("faces", params.faces).fixes("lobes", params.lobes);
}

std::uint32_t iterations(const LpvParams& params, const DeviceGrid& grid) {
    return params.iterations > 0 ? params.iterations : grid.grid.iterations;
}

ComputeStep fix_links(ComputeStep builder, const DeviceGrid& grid, std::uint32_t step) {
    const bool is_fuzzy = grid.is_fuzzy && step > 0;
    const Buffer& links = is_fuzzy ? grid.later_links : grid.has_links ? grid.links : grid.sums;
    return builder.loads("Links", links).fixes("has_links", is_fuzzy || grid.has_links ? 1u : 0u);
}

void propagate(Graph& graph, const FrameImages& frame, const LpvParams& params, DeviceGrid& grid,
               const std::function<void(std::uint32_t step, const Buffer& light)>& look) {
    find_links(graph, frame, grid);
    if (grid.is_fuzzy && !grid.later_links) find_fuzzy_links(graph, frame, grid);
    Buffer now = grid.even ? grid.even : graph.create(grid.name("light of even steps of grid"), grid.step_bytes());
    Buffer next = grid.odd ? grid.odd : graph.create(grid.name("light of odd steps of grid"), grid.step_bytes());
    if (!grid.total) grid.total = graph.create(grid.name("light of grid"), grid.total_bytes());
    resolve(graph, params, grid, now);
    look(0, now);
    for (std::uint32_t step = 0; step < iterations(params, grid); ++step) {
        gated(fix_links(fix_faces(graph.compute("indirect/lpv/propagation/propagate.comp"), params), grid, step)
                  .loads("Before", now)
                  .stores("After", next)
                  .updates("Total", grid.total)
                  .fixes("cell_storage", grid.storage)
                  .fixes("channels", grid.channels)
                  .push(grid.place),
              grid, gate_first_step + step, grid.threads());
        std::swap(now, next);
        look(step + 1, now);
    }
}

}  // namespace strata::indirect
