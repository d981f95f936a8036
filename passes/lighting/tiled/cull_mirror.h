// Culling of one tile on the CPU in float: the phases of cull.comp with vectors where that has LDS, and loops where that has
// threads. What the two find is the same to the last bit of every mask, but for lights that touch a cell within rounding.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "passes/lighting/tile_cell.h"
#include "passes/lighting/tiled/tiled.shared.h"
#include "passes/lighting/tiled/tiled_params.h"
#include "passes/scene/light_records.h"
#include "passes/shaders/scene/view.shared.h"

namespace strata::lighting {

/// What culling reads of a scene, as on the device.
struct CullScene : LightRecords {
    ViewRecord view{};
    std::uint32_t shadow_features = 0;  ///< of shadows that shading looks up or filters
};

/// What is lit in a tile.
struct TileSurfaces {
    std::vector<float> depths;  ///< view z of its samples, meters
    std::uint32_t models = 0;   ///< their features
};

struct ListedLight {
    std::uint32_t light = 0, blockers = 0, portals = 0;  ///< masks: the light's own that pixels test
    friend bool operator==(const ListedLight&, const ListedLight&) = default;
};

struct MirroredTile {
    bool empty = true;
    std::vector<ListedLight> lights;
    std::uint32_t spectrum = 0, overflow = 0, records = 1;
    std::uint32_t touching = 0, killed = 0;
    std::uint32_t portal_pairs = 0, blocker_pairs = 0;                 ///< the most of a batch
    std::array<std::uint32_t, 3> portal_classes{}, blocker_classes{};  ///< none, partial, full
    std::uint32_t undecided = 0;                                       ///< lights that more or less slack would decide otherwise
};

/// One cell, or two with half-Z; none where nothing is lit.
std::vector<Cell<float>> cells_of_tile(const ViewRecord&, const TiledParams&, glm::uvec2 tile, std::span<const float> depths);

MirroredTile cull_tile(const CullScene&, const TiledParams&, glm::uvec2 tile, const TileSurfaces&);

}  // namespace strata::lighting
