// How many waves a SIMD holds of the shader that shades each tile: what a run says of a technique's variants, joined with what a
// GPU's compiler made of them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "replay/difference/canvas.h"
#include "replay/images/host_image.h"
#include "replay/isa/occupancy.h"
#include "replay/isa/pipeline_request.h"
#include "replay/session/session.h"

namespace strata {

struct IsaOfGpu;

/// One variant of the technique's shader.
struct VariantWaves {
    std::vector<double> row;  ///< of the technique's table
    std::uint32_t number = 0;
    std::uint64_t tiles = 0;          ///< that it shades
    std::optional<double> registers;  ///< vector registers of a lane
    Occupancy occupancy;
};

struct TileWaves {
    std::string technique, constant;     ///< a variant is told by this specialization constant
    std::vector<TableColumn> columns;    ///< of the technique's table
    std::vector<VariantWaves> variants;  ///< in the order of that table
    std::uint64_t tiles = 0;             ///< that anything shades
    double mean = 0;                     ///< waves per SIMD over these tiles
    HostImage picture;                   ///< r32f: waves per SIMD of each pixel's variant; 0 where nothing is shaded
};

/// The technique that tells which variant shades what, see technique_with().
Result<const Technique*> technique_of_variants(const ChoiceChanges&);
/// What a run must bring back for it: its view and its table.
std::vector<std::string> outputs_of_variants(const Technique&);

/// What is joined: the compiled passes of a plan in which the technique shades, and a run of the same choices with
/// outputs_of_variants().
struct TilesAndCode {
    const Technique& technique;
    const Run& run;
    const IsaOfGpu& gpu;
    const PipelineRequests& requests;
};
/// Fails (usage) where nothing is shaded, with the reason; (device lacks) where the compiler says too little of a variant.
Result<TileWaves> waves_of_tiles(const TilesAndCode&);

/// The picture in colors, from black for nothing to a pale yellow for a SIMD with all slots taken, and what the colors stand for.
Canvas tile_waves_picture(const TileWaves&, const GpuModel&);

}  // namespace strata
