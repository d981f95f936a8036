#include "passes/lighting/tiled/ratios.h"

namespace strata::lighting {

// The talk gives no times; what its choices are for is in its words: fewer tests per pixel, and more waves for tiles that need
// little.
std::vector<TimeRatio> tiled_ratios() {
    using Names = std::vector<std::string_view>;
    const Names stage = {}, shading = {"/shade"}, culling = {"/cull", "/macro"};
    const Names tested = {"lights kept", "lights killed", "blocker tests"}, listed = {"lights touching", "lights kept"},
                chosen = {"modes used", "evaluations"}, evaluated = {"evaluations", "samples_shaded"};
    return {
        {"the stage: blockers against tiles and pixels, against pixels alone", "classify=on", "classify=off", stage, std::nullopt,
         "", "agents_hq", tested},
        {"the stage: blockers against tiles, against letting light through", "classify=on", "blockers=off", stage, std::nullopt,
         "", "agents_hq", tested},
        {"the stage: blockers against tiles, more pairs than fit", "classify=on", "classify=off", stage, std::nullopt, "",
         "pair_overflow", tested},
        {"shading: 16 modes, against one of all features", "modes=16", "modes=1", shading, std::nullopt, "", "agents_hq", chosen},
        {"shading: 8 modes, against one of all features", "modes=8", "modes=1", shading, std::nullopt, "", "agents_hq", chosen},
        {"shading: 8 modes, against one that branches by tile", "modes=8", "branches=uniform", shading, std::nullopt, "",
         "agents_hq", chosen},
        {"the stage: two cells per tile, against one", "half_z=on", "half_z=off", stage, std::nullopt, "", "agents_hq", listed},
        {"the stage: shadows filtered for what is lit, against looked up", "shadows=inline", "shadows=image", stage, std::nullopt,
         "", "agents_hq", evaluated},
        {"culling: candidates of macro tiles, against all of 512 lights", "prefilter=on", "prefilter=off", culling, std::nullopt,
         "", "hall_of_lights_512", listed},
        {"culling: candidates of macro tiles, against all of 4096 lights", "prefilter=on", "prefilter=off", culling, std::nullopt,
         "", "hall_of_lights_4096", listed},
        {"the stage: against a loop over 64 lights", "half_z=on", "brute_force", stage, std::nullopt, "", "hall_of_lights_64",
         evaluated},
        {"the stage: against a loop over 512 lights", "half_z=on", "brute_force", stage, std::nullopt, "", "hall_of_lights_512",
         evaluated},
        {"the stage: against a loop over 4096 lights", "half_z=on", "brute_force", stage, std::nullopt, "", "hall_of_lights_4096",
         evaluated},
    };
}

}  // namespace strata::lighting
