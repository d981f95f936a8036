// The steps that find each tile's lights, its mode, and which tiles a mode has.
#pragma once

#include <cstdint>

#include "passes/graph/step.h"
#include "passes/lighting/tiled/tiled.shared.h"
#include "passes/lighting/tiled/tiled_params.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::lighting {

struct CulledTiles {
    Buffer records;     ///< TileRecord: one of each tile, then those of further batches
    Buffer statistics;  ///< TileStatistics by tile
    Buffer dispatches;  ///< ModeDispatch by mode
    Buffer tiles;       ///< by mode, then in the order of the screen
    std::uint32_t across = 0, down = 0;
    ModeOrder order{};
    std::uint32_t count() const { return across * down; }
};

/// How many lights and records a frame needs on the device.
struct TileMemory {
    std::uint32_t listed_lights = 0;
    std::uint32_t spare_records = 0;  ///< for tiles with more than 64 lights
    std::uint64_t record_bytes = 0, candidate_bytes = 0;
    bool lists_every_light = true;  ///< in every tile, however many lights reach it
};
TileMemory tile_memory(Extent, std::size_t lights);

/// Needs the G-buffer.
CulledTiles cull_tiles(Graph&, const FrameImages&, const TiledParams&);

/// Whether shading looks shadows up or filters them.
bool has_shadows(const FrameImages&, const TiledParams&);

}  // namespace strata::lighting
