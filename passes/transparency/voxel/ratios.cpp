#include "passes/transparency/voxel/ratios.h"

namespace strata::transparency {

// The talk's figures: its tables of splats, of skipping, of what RGB costs, and of techniques. Its splats of 17 million pixels at
// 1080p are eight layers, as the scenario particle_storm has; its techniques are compared at an eighth of the extent.
std::vector<TimeRatio> voxel_ratios() {
    using Names = std::vector<std::string_view>;
    const Names splat = {"/splat"}, clear = {"/clear"}, integrate = {"/integrate"}, volume = {"/clear", "/integrate"},
                draws = {"/accumulate"}, zero = {"/zero_depth", "/quads", "/full_screen"}, stage = {};
    const Names added = {"atomics", "border atomics", "overflowed"}, drawn = {"drawn", "atomics"},
                blended = {"drawn", "fragments", "atomics"}, culled = {"drawn", "unseen", "zero tiles"},
                filled = {"voxels", "cleared", "integrated"}, warped = {"slices used", "virtual slices", "blocks"};
    const RatioWitness overflow = {"overflowed", "nothing overflowed"}, opaque = {"zero tiles", "no tile becomes opaque"};
    return {
        {"splat: compare-and-swap that saturates, against noting overflows", "splat=saturating", "splat=overflow_minimum", splat,
         1.95 / .91, "1.95 / .91 ms, 17 million pixels, 1080p, PS5", "ash_storm", added, overflow},
        {"splat: noting overflows, against letting them wrap", "splat=overflow_minimum", "splat=wrapping", splat, .91 / .89,
         ".91 / .89 ms, 17 million pixels, 1080p, PS5", "ash_storm", added, overflow},
        {"splat: a word per slice, against noting overflows", "splat=words", "splat=overflow_minimum", splat, .91 / .91,
         ".91 / .91 ms, 17 million pixels, 1080p, PS5", "ash_storm", added, overflow},
        {"splat: into two slices, against one", "splatting=linear", "splatting=point", splat, .81 / .75,
         ".81 / .75 ms, mono; the slide shows the numbers of its formats once more", "particle_storm", added},
        {"splat: RGB, against mono", "channels=rgb", "channels=mono", splat, .95 / .81,
         ".95 / .81 ms, linear; the slide shows the numbers of its formats once more", "particle_storm", added},
        {"splat: words of three channels and bytes of what is gray, against bytes alone", "packing=rgb10", "channels=mono", splat,
         .95 / .91, ".95 / .91 ms, 10:10:10 and U8, both noting overflows", "glass_and_smoke", added},
        {"splat: three channels at once, against one by one", "packing=rgb10", "packing=planes", splat, std::nullopt, "",
         "glass_and_smoke", added},
        {"clearing: every voxel, against those in use", "skipping=off volume=dense range=fixed", "volume=dense range=fixed",
         clear, .153 / .01, ".153 / .01 ms, 1440p", "glass_and_smoke", filled},
        {"integration: every voxel, against those in use", "skipping=off volume=dense range=fixed", "volume=dense range=fixed",
         integrate, .2 / .04, ".2 / .04 ms, 1440p", "glass_and_smoke", filled},
        {"the stage: slices where something is, against everywhere", "volume=adaptive", "volume=dense", stage, std::nullopt, "",
         "smoke_grenade", warped},
        {"the stage: blocks where something is, against slices", "volume=sparse", "volume=adaptive", stage, std::nullopt, "",
         "smoke_grenade", warped},
        {"clearing and integration: RGB, against mono", "channels=rgb", "channels=mono", volume, 3., "3 times for each",
         "particle_storm", filled},
        {"zero-transmittance depth: pixel by pixel, against quads", "culling=full_screen", "culling=quads_16", zero, .2 / .014,
         ".2 / .014 ms, 4K from 480 x 270", "smoke_core", culled, opaque},
        {"draws: all, against what is seen", "culling=off", "culling=quads_16", draws, 2.035 / 1.78,
         "2.035 / 1.78 ms, 21276176 / 18922855 fragments", "smoke_core", culled, opaque},
        {"draws: RGB, against mono", "channels=rgb", "channels=mono", draws, 1.05, "1.05 times", "particle_storm", drawn},
        {"the stage: RGB, against mono", "channels=rgb", "channels=mono", stage, 3.11 / 2.95, "3.11 / 2.95 ms; 2.8 without",
         "particle_storm", drawn},
        {"the stage: against blending in object order", "resolution=eighth", "alpha_blend", stage, 4.967 / 4.4,
         "4.967 / 4.4 ms, adaptive and culled; 5.667 with nothing culled", "smoke_grenade", blended},
        {"the stage: against moments", "resolution=eighth", "moments resolution=eighth", stage, 4.967 / 5.705,
         "4.967 / 5.705 ms, adaptive and culled", "smoke_grenade", blended},
        {"the stage: against wavelets", "resolution=eighth", "wavelet resolution=eighth", stage, 4.967 / 5.908,
         "4.967 / 5.908 ms, adaptive and culled", "smoke_grenade", drawn},
    };
}

}  // namespace strata::transparency
