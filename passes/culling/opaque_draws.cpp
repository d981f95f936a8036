// Which draws stand in the scene's opaque lists.
#include "passes/culling/opaque_draws.h"

namespace strata {

std::vector<std::uint32_t> caster_draws(const Frame& frame) {
    std::vector<std::uint32_t> indices = opaque_draws(frame);
    std::erase_if(indices, [&](std::uint32_t draw) { return !frame.draws[draw].casts_shadow; });
    return indices;
}

}  // namespace strata
