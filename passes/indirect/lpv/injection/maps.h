// Reflective shadow maps: what lights see, from which light is injected (Dachsbacher and Stamminger, Reflective Shadow Maps, I3D
// 2005).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "capture_format/view.h"
#include "passes/graph/step.h"
#include "passes/indirect/lpv/light_eye.h"
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/scene/light_grids.h"
#include "passes/scene/read_part.h"

namespace strata {

class Graph;         // passes/graph/graph.h
class SceneFacts;    // passes/scene/scene_facts.h
struct FrameImages;  // passes/frame_images.h
struct Light;        // capture_format/frame/light.h

}  // namespace strata

namespace strata::indirect {

/// Of one light: where each map looks, and what makes watts of a texel's light.
struct LightMaps {
    std::vector<MapPush> views;
    std::vector<MapPart> parts;  ///< by view: the texels that may see a surface that reflects into a grid
    std::uint32_t size = 0;      ///< texels a side
    glm::vec2 slopes{0};         ///< of the maps' sides; 0 for parallel light
    float texel_area = 0;        ///< of parallel light, square meters
    glm::vec3 light{0};          ///< its place, and where it ends, meters; 0 and 0 for parallel light
    float range = 0;
};

/// How fine maps are.
struct MapTexels {
    std::uint32_t most = 0;  ///< a side
    double per_cell = 0;     ///< halfway to where a light ends; 0: as many as `most`
};
/// Texels a side of the maps of a light that has a position: so many that `per_cell` of them are as wide as a cell of any of the
/// frame's grids, in multiples of 8, at least 16. A cascade counts wherever it is, and light ends in it at its range, so that
/// maps stay as they are when the eye moves; a local grid counts where the light reaches it.
std::uint32_t texels_a_side(const Light&, std::span<const LightGrid>, MapTexels);

/// The maps of a light that has a position, as an eye sees it: one of a spot, else six, without those that see nothing of any of
/// the grids.
LightMaps maps_around(const View&, const Light&, std::span<const LightGrid* const>, std::uint32_t texels_a_side);
/// One map of parallel light over the grid, three times as fine. A grid that moves by whole cells up or down has other texels on
/// its walls: the light of `courtyard` changes by 11 % with as large a map, by 2.7 % with one twice as large.
LightMaps maps_over(const SceneFacts&, const View&, const Light&, const LightGrid&, MapTexels);
inline constexpr std::uint32_t parallel_map_scale = 3;

/// Whether a light adds light to a grid: it shines, and its range reaches what the grid's cells are before. Its negative channels
/// inject nothing.
bool injects(const Light&, const LightGrid&);
/// The most that a light can send in all directions and channels, W; of parallel light into a grid. For sums in fixed point.
double most_flux(const Light&, const LightGrid&);

/// Images with a layer per view, drawn. `casters`: all of them for each view in turn, those that it need not draw without
/// instances.
struct MapImages {
    Image position, normal, albedo;
};
MapImages draw_maps(Graph&, const FrameImages&, const LightMaps&, const LightEye&, DrawList casters);

}  // namespace strata::indirect
