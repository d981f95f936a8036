// Parameters of two-phase occlusion culling.
#pragma once

#include <cstdint>

namespace strata {

struct HizParams {
    std::uint32_t phases;
    std::uint32_t occluders;
    std::uint32_t across;
    std::uint32_t level;
};

}  // namespace strata
