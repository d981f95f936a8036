#include "passes/indirect/lpv/injection/bounce_model.h"

namespace strata::indirect::in_double {

std::vector<VirtualLight> reflected(std::span<const Surfel> surfels, LitGrid lit) {
    lit.irradiance = irradiance_cell;  // the rule that keeps energy
    std::vector<VirtualLight> lights;
    for (const Surfel& surfel : surfels) {
        if (grid_share(lit.grid, surfel.position) == 0) continue;
        for (const double side : {1., -1.}) {
            if (side < 0 && !surfel.has_two_sides) break;
            const Receiver at{surfel.position, side * surfel.normal};
            lights.push_back({at.position, at.normal, surfel.albedo * irradiance(lit, at) * surfel.area});
        }
    }
    return lights;
}

}  // namespace strata::indirect::in_double
