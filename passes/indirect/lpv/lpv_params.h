// Parameters of light propagation volumes. Their choices are the constants of lpv.shared.h.
#pragma once

#include <cstdint>

namespace strata::indirect {

struct LpvParams {
    std::uint32_t iterations;  ///< 0: as the capture's volume says
    std::uint32_t propagation;
    std::uint32_t faces;
    std::uint32_t occlusion;
    std::uint32_t taps;
    std::uint32_t map_size;  ///< texels a side of reflective shadow maps, at most
    float map_density;       ///< texels per cell halfway to where a light ends; 0: map_size a side
    float injection;         ///< cells along the normal of what is injected
    std::uint32_t irradiance;
    std::uint32_t macro_cells;  ///< whether taps ask only the blockers of their macro-cell
    std::uint32_t apply_resolution;
    std::uint32_t relight;
    std::uint32_t slice;      ///< steps of propagation per frame with relight_changed; 0: all of them
    float damping;            ///< exponent; 0: off
    std::uint32_t tap_tiles;  ///< whether tiles near no blocker have a shader that asks none
    std::uint32_t bounces;
    std::uint32_t cell_scale;    ///< cells_...
    std::uint32_t cell_storage;  ///< storage_...
    std::uint32_t self_light;    ///< self_...
    float reading;               ///< cells before a surface at which cells are read
    std::uint32_t lobes;         ///< lobes_...
};

}  // namespace strata::indirect
