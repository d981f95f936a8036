#include "passes/transparency/voxel/ratios.h"

namespace strata::transparency {

// The talk's figures: its tables of splats, of what RGB costs, and of methods. Its splats of 17 million pixels at 1080p are eight
// layers, as the scenario particle_storm has; its methods are compared at an eighth of the extent.
std::vector<TimeRatio> voxel_ratios() {
    using Names = std::vector<std::string_view>;
    const Names splat = {"/splat"}, volume = {"clear voxels", "/integrate"}, draws = {"/accumulate"}, stage = {};
    const Names added = {"atomics", "border atomics", "overflowed"}, drawn = {"drawn", "fragments", "atomics"},
                filled = {"columns"};
    return {
        {"splat: compare-and-swap that saturates, against noting overflows", "splat=saturating", "splat=overflow_minimum", splat,
         1.95 / .91, "1.95 / .91 ms, 17 million pixels, 1080p, PS5", "particle_storm", added},
        {"splat: noting overflows, against letting them wrap", "splat=overflow_minimum", "splat=wrapping", splat, .91 / .89,
         ".91 / .89 ms, 17 million pixels, 1080p, PS5", "particle_storm", added},
        {"splat: a word per slice, against noting overflows", "splat=words", "splat=overflow_minimum", splat, .91 / .91,
         ".91 / .91 ms, 17 million pixels, 1080p, PS5", "particle_storm", added},
        {"splat: into two slices, against one", "splatting=linear", "splatting=point", splat, .81 / .75,
         ".81 / .75 ms, mono; the slide shows the numbers of its formats once more", "particle_storm", added},
        {"splat: RGB, against mono", "channels=rgb", "channels=mono", splat, .95 / .81,
         ".95 / .81 ms, linear; the slide shows the numbers of its formats once more", "particle_storm", added},
        {"clearing and integration: RGB, against mono", "channels=rgb", "channels=mono", volume, 3., "3 times for each",
         "particle_storm", filled},
        {"draws: RGB, against mono", "channels=rgb", "channels=mono", draws, 1.05, "1.05 times", "particle_storm", drawn},
        {"the stage: RGB, against mono", "channels=rgb", "channels=mono", stage, 3.11 / 2.95, "3.11 / 2.95 ms; 2.8 without",
         "particle_storm", drawn},
        {"the stage: against blending in object order", "resolution=eighth", "alpha_blend", stage, 5.667 / 4.4,
         "5.667 / 4.4 ms, adaptive, nothing culled", "smoke_grenade", drawn},
        {"the stage: against moments", "resolution=eighth", "moments resolution=eighth", stage, 5.667 / 5.705,
         "5.667 / 5.705 ms, adaptive, nothing culled", "smoke_grenade", drawn},
        {"the stage: against wavelets", "resolution=eighth", "wavelet resolution=eighth", stage, 5.667 / 5.908,
         "5.667 / 5.908 ms, adaptive, nothing culled", "smoke_grenade", drawn},
    };
}

}  // namespace strata::transparency
