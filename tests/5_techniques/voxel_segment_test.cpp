// Thick fragments of transparency/voxel on a device (docs/algorithms/transparency.md 6.5, thick objects).
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/5_techniques/voxel_name.h"
#include "tests/support/agreement.h"
#include "tests/support/session.h"

namespace strata {
namespace {

const char* const soft_scenarios[] = {"smoke_grenade", "glass_and_smoke", "explosion", "interface_layers"};

Request thick(std::string_view scenario, std::vector<std::string> sets, std::uint32_t samples = 1) {
    Request request = on_scenario(scenario, samples);
    request.choices = chosen({voxel}, std::move(sets)), request.outputs = {"color"};
    set(request, "thickness=segment");
    return request;
}

std::vector<std::byte> color_of(const Request& request) {
    return must(session_of_scenarios().run(request)).images.at("color").texels;
}

TEST(ExhaustiveVoxelSegmentOnDevice, IsWhatTheModelSays) {
    const Technique& technique = *must(find_technique(voxel));
    const std::vector<std::string> combinations[] = {
        {"sampling=linear"},
        {"splatting=point", "sampling=point", "volume=dense"},
        {"bits=16", "sampling=bicubic", "resolution=half", "rounding=stochastic"},
        {"packing=rgb10", "channels=rgb", "slices=500", "splat=saturating"},
    };
    for (const char* scenario : soft_scenarios)
        for (const std::vector<std::string>& sets : combinations) {
            Request request = thick(scenario, sets);
            const Accuracy accuracy = must(session_of_scenarios().judge(request, technique.stage, Against::model));
            expect_within_tolerance(accuracy, technique, request, scenario);
        }
}

TEST(ExhaustiveVoxelSegmentOnDevice, IsCoveredAndKeptWhereItReaches) {
    for (const char* scenario : soft_scenarios)
        for (const char* splatting : {"splatting=linear", "splatting=point"}) {
            const std::vector<std::string> sets = {splatting, "sampling=bicubic", "slices=200", "resolution=half"};
            Request skipping = thick(scenario, sets, 4), plain = skipping;
            set(plain, "skipping=off");
            const auto kept = must(session_of_scenarios().run(skipping));
            EXPECT_EQ(kept.images.at("color").texels, color_of(plain)) << scenario << splatting;
            EXPECT_EQ(counted(kept, "uncovered"), 0u) << scenario << splatting;
        }
}

TEST(VoxelSegmentOnDevice, IsCulledWithoutATrace) {
    for (const char* scenario : soft_scenarios)
        EXPECT_EQ(color_of(thick(scenario, {"culling=quads_16"})), color_of(thick(scenario, {"culling=off"}))) << scenario;
}

void expect_points(Request request) {
    const auto as_segments = color_of(request);
    set(request, "thickness=point");
    EXPECT_EQ(color_of(request), as_segments);
}

TEST(VoxelSegmentOnDevice, IsAPointWhereNoParticleIsSoftAndWhereTrianglesAreMultiplied) {
    expect_points(thick("particle_storm", {}));
    expect_points(thick("explosion", {"splat=multiply"}));
}

}  // namespace
}  // namespace strata
