#include "passes/lighting/tiled/ratios.h"

namespace strata::lighting {

// The talk gives no times; what its choices are for is in its words: fewer tests per pixel, and more waves for tiles that need
// little.
std::vector<TimeRatio> tiled_ratios() {
    using Names = std::vector<std::string_view>;
    const Names stage = {}, shading = {"/shade"}, culling = {"/cull", "/macro"};
    const Names tested = {"lights kept", "lights killed", "blocker tests"}, listed = {"lights touching", "lights kept"},
                chosen = {"modes used", "evaluations"}, evaluated = {"evaluations", "samples_shaded"};
    struct Row {
        std::string_view name, of, against, scenario;
        const Names &steps, &counters;
    };
    const Row rows[] = {
        {"the stage: blockers against tiles and pixels, against pixels alone", "classify=on", "classify=off", "agents_hq", stage,
         tested},
        {"the stage: blockers against tiles, against letting light through", "classify=on", "blockers=off", "agents_hq", stage,
         tested},
        {"the stage: blockers against tiles, more pairs than fit", "classify=on", "classify=off", "pair_overflow", stage, tested},
        {"shading: 16 modes, against one of all features", "modes=16", "modes=1", "agents_hq", shading, chosen},
        {"shading: 8 modes, against one of all features", "modes=8", "modes=1", "agents_hq", shading, chosen},
        {"shading: 16 modes, against one that branches by tile", "modes=16", "branches=uniform", "agents_hq", shading, chosen},
        {"shading: 8 modes, against one that branches by tile", "modes=8", "branches=uniform", "agents_hq", shading, chosen},
        {"shading: 8 modes, against the talk's three and one of all features", "modes=8",
         "modes=3 mode_0=1124 mode_1=1271 mode_2=2047", "agents_hq", shading, chosen},
        {"shading: what tiles call for, against every feature in each", "force=0", "force=65535", "agents_hq", shading, chosen},
        {"the stage: two cells per tile, against one", "half_z=on", "half_z=off", "agents_hq", stage, listed},
        {"the stage: shadows filtered for what is lit, against looked up", "shadows=inline", "shadows=image", "agents_hq", stage,
         evaluated},
        {"culling: candidates of macro tiles, against all of 512 lights", "prefilter=on", "prefilter=off", "hall_of_lights_512",
         culling, listed},
        {"culling: candidates of macro tiles, against all of 4096 lights", "prefilter=on", "prefilter=off", "hall_of_lights_4096",
         culling, listed},
        {"the stage: against a loop over 64 lights", "half_z=on", "brute_force", "hall_of_lights_64", stage, evaluated},
        {"the stage: against a loop over 512 lights", "half_z=on", "brute_force", "hall_of_lights_512", stage, evaluated},
        {"the stage: against a loop over 4096 lights", "half_z=on", "brute_force", "hall_of_lights_4096", stage, evaluated},
    };
    std::vector<TimeRatio> ratios;
    for (const Row& row : rows)
        ratios.push_back({.name = row.name,
                          .of = row.of,
                          .against = row.against,
                          .steps = row.steps,
                          .scenario = row.scenario,
                          .counters = row.counters});
    return ratios;
}

}  // namespace strata::lighting
