// Where a frame's light volumes lie, as grids of cubic cells along the world's axes (docs/algorithms/lighting.md 5.7).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame/light_volume.h"

namespace strata {

struct Frame;  // capture_format/frame.h

struct LightGrid {
    glm::dvec3 origin{0};  ///< world: the corner of cell (0, 0, 0)
    double cell = 1;       ///< meters a side
    glm::uvec3 cells{1};
    VolumeOcclusion occlusion = VolumeOcclusion::none;
    std::uint32_t iterations = 0;
    bool is_local = false;  ///< stays where it is; a cascade follows the camera in steps of a cell
};

/// A volume's cells are cubes as wide as the widest of what its extent and number of cells say. In the order in which a point
/// takes the first that holds it: local volumes as recorded, then cascades, of each volume the finest first. With a scale other
/// than 1, cells are so many times as wide as recorded, and as many more or fewer.
std::vector<LightGrid> light_grids(const Frame&, double cell_scale = 1);

}  // namespace strata
