// Parameters of tiled lighting. Their choices are the constants of tiled.shared.h.
#pragma once

#include <cstdint>

namespace strata::lighting {

struct TiledParams {
    std::uint32_t half_z;
    std::uint32_t blockers;
    std::uint32_t classify;
    std::uint32_t overflow;
    std::uint32_t prefilter;
    std::uint32_t shadows;
    std::uint32_t branches;
    std::uint32_t force;
    std::uint32_t modes;
    std::uint32_t mode_0, mode_1, mode_2, mode_3, mode_4, mode_5, mode_6, mode_7;
    std::uint32_t mode_8, mode_9, mode_10, mode_11, mode_12, mode_13, mode_14, mode_15;
};

}  // namespace strata::lighting
