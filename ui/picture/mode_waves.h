// Waves per SIMD of the mode that shades each tile, for a GPU that need not be there: `strata isa --tiles` for a panel.
#pragma once

#include "replay/isa/tile_waves.h"
#include "ui/replayer/work_queue.h"

namespace strata::ui {

/// The models that the compiler compiles for.
std::vector<const GpuModel*> compilable_gpus();

/// Of a technique with variants.
struct ModesOnGpu {
    const Technique& technique;
    const GpuModel& gpu;
    std::filesystem::path program = {};  ///< Model::program
};

/// Compiles the technique's variants alone, each in a process of its own, so that pictures people wait for go in between.
Result<TileWaves> waves_of_modes(Session&, Progress&, const Request&, const ModesOnGpu&);

}  // namespace strata::ui
