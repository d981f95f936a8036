// Reflective shadow maps: what lights see, from which light is injected (Dachsbacher and Stamminger, Reflective Shadow Maps, I3D
// 2005).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "passes/graph/step.h"
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/scene/light_grids.h"

namespace strata {

class Graph;         // passes/graph/graph.h
class SceneFacts;    // passes/scene/scene_facts.h
struct FrameImages;  // passes/frame_images.h
struct Light;        // capture_format/frame/light.h

}  // namespace strata

namespace strata::indirect {

/// Casters that stand together in FrameImages::casters.
struct CasterRun {
    std::uint32_t first = 0, count = 0;
};

struct MapPart {
    PixelColumns columns;
    Rows rows;
};

/// Of one light: where each map looks, and what makes watts of a texel's light.
struct LightMaps {
    std::vector<MapPush> views;
    std::vector<std::vector<CasterRun>> casters;  ///< by view: those that may reflect into a grid, or stand before what does
    std::vector<MapPart> parts;                   ///< by view: the texels that may see a surface that does
    std::uint32_t size = 0;                       ///< texels a side
    glm::vec2 slopes{0};                          ///< of the maps' sides; 0 for parallel light
    float texel_area = 0;                         ///< of parallel light, square meters
};

/// The maps of a light that has a position: one of a spot, else six, without those that see nothing of any of the grids.
LightMaps maps_around(const SceneFacts&, const Light&, std::span<const LightGrid* const>, std::uint32_t map_size);
/// One map of parallel light over the grid, three times as large. A grid that moves by whole cells up or down has other texels on
/// its walls: the light of `courtyard` changes by 11 % with as large a map, by 2.7 % with one twice as large.
LightMaps maps_over(const SceneFacts&, const Light&, const LightGrid&, std::uint32_t map_size);
inline constexpr std::uint32_t parallel_map_scale = 3;

/// Whether a light adds light to a grid: it shines, and its range reaches what the grid's cells are before. Its negative channels
/// inject nothing.
bool injects(const Light&, const LightGrid&);
/// The most that a light can send in all directions and channels, W; of parallel light into a grid. For sums in fixed point.
double most_flux(const Light&, const LightGrid&);

/// Images with a layer per view, drawn.
struct MapImages {
    Image position, normal, albedo;
};
MapImages draw_maps(Graph&, const FrameImages&, const LightMaps&);

}  // namespace strata::indirect
