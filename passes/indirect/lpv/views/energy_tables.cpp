#include "passes/indirect/lpv/views/energy_tables.h"

#include <vector>

#include "passes/frame_images.h"
#include "passes/indirect/lpv/injection/bounce.h"
#include "passes/indirect/lpv/injection/injection.h"
#include "passes/indirect/lpv/propagation/propagation.h"
#include "passes/indirect/lpv/volumes.h"
#include "passes/settings.h"

namespace strata::indirect {
namespace {

/// Rows of a table of energy, written in order.
class EnergyRows {
public:
    EnergyRows(Graph& graph, const LpvParams& params, std::uint32_t rows)
        : graph_(&graph),
          params_(params),
          numbers_(graph.create("energy", {.extent = {1, rows}, .format = Format::rgba32f})),
          lost_(graph.create("lost energy", sizeof(EnergySum))) {
        graph.clear(numbers_, {});
        graph.clear(lost_, 0);
    }
    /// What the cells hold before a step, and what all rows before this one lost in theirs.
    void add(std::uint32_t row, const DeviceGrid& grid, std::uint32_t step, const Buffer& light) {
        fix_links(fix_faces(graph_->compute("indirect/lpv/propagation/energy.comp"), params_), grid, step)
            .loads("Before", light)
            .updates("numbers", numbers_)
            .updates("Lost", lost_)
            .loads("Total", grid.total)
            .fixes("cell_storage", grid.storage)
            .fixes("channels", grid.channels)
            .push(EnergyPush{.grid = grid.place, .step = row})
            .groups({1, 1, 1});
    }
    Image numbers() const { return numbers_; }

private:
    Graph* graph_;
    LpvParams params_;
    Image numbers_;
    Buffer lost_;
};

std::vector<DeviceGrid> injected_grids(Graph& graph, const FrameImages& frame, const LpvParams& params) {
    std::vector<DeviceGrid> grids = make_grids(graph, frame, params);
    inject_lights(graph, frame, params, grids);
    return grids;
}

}  // namespace

Image energy_table(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<LpvParams>();
    std::vector<DeviceGrid> grids = injected_grids(graph, frame, params);
    EnergyRows rows(graph, params, grids.empty() ? 1 : iterations(params, grids.front()) + 1);
    if (grids.empty()) return rows.numbers();
    DeviceGrid& grid = grids.front();
    propagate(graph, frame, params, grid, [&](std::uint32_t step, const Buffer& light) { rows.add(step, grid, step, light); });
    return rows.numbers();
}

Image bounces_table(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<LpvParams>();
    std::vector<DeviceGrid> grids = injected_grids(graph, frame, params);
    EnergyRows rows(graph, params, params.bounces);
    if (grids.empty()) return rows.numbers();
    DeviceGrid grid = grids.front();
    for (std::uint32_t bounce = 0; bounce < params.bounces; ++bounce) {
        if (bounce > 0) grid = reflected(graph, frame, params, grid);
        propagate(graph, frame, params, grid, [&](std::uint32_t step, const Buffer& light) {
            if (step == 0) rows.add(bounce, grid, step, light);
        });
    }
    return rows.numbers();
}

}  // namespace strata::indirect
