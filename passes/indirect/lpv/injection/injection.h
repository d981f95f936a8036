// What lights reach, put into the cells of grids.
#pragma once

#include <vector>

#include "passes/indirect/lpv/device_grid.h"
#include "passes/indirect/lpv/injection/maps.h"
#include "passes/indirect/lpv/lpv_params.h"

namespace strata::indirect {

inline MapTexels map_texels(const LpvParams& params) { return {.most = params.map_size, .per_cell = double(params.map_density)}; }

/// 1 in the fixed point of a grid's sums: 2^k such that all that lights can send is no more than 2^30 of a coefficient.
double fixed_one(const SceneFacts&, const LightGrid&);

/// Fills the sums of the grids. A light's maps serve all the grids that it reaches; those of parallel light are laid over each
/// grid.
void inject_lights(Graph&, const FrameImages&, const LpvParams&, std::vector<DeviceGrid>&);

}  // namespace strata::indirect
