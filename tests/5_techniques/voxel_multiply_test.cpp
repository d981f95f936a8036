// transparency/voxel with splat=multiply: no atomics, every triangle blended into one slice by a layered draw.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "passes/transparency/voxel/factors/model.h"
#include "tests/5_techniques/voxel_name.h"
#include "tests/support/agreement.h"
#include "tests/support/session.h"
#include "tests/support/test_frame.h"

namespace strata {
namespace {

Run multiplied_run(Session& session, std::vector<std::string> sets = {}) {
    sets.push_back("splat=multiply");
    session.forget_memo();
    return must(session.run({.choices = chosen({voxel}, std::move(sets)), .outputs = {"color"}}));
}

/// What comes through a geometry shader is interpolated with other roundings: a factor here and there is a code off, of 255.
TEST(ExhaustiveVoxelMultiply, IsTheSameWhicheverShaderChoosesTheLayer) {
    for (const char* scenario : {"smoke_grenade", "glass_and_smoke", "interpenetrating_panes"}) {
        const auto session = scenario_session(scenario, 4);
        const auto without =
            must(Session::open(scenario_frames(scenario, 4), {.validation = true, .without = {"shader_output_layer"}}));
        ASSERT_TRUE(has(session->device().capabilities, Capability::shader_output_layer));
        ASSERT_FALSE(has(without->device().capabilities, Capability::shader_output_layer));
        const ReferenceImage by_vertex = in_double(multiplied_run(*session).images.at("color"));
        const ReferenceImage by_geometry = in_double(multiplied_run(*without).images.at("color"));
        std::size_t different = 0;
        for (std::size_t i = 0; i < by_vertex.texels.size(); ++i) {
            const glm::dvec4 error = glm::abs(by_vertex.texels[i] - by_geometry.texels[i]);
            if (error != glm::dvec4(0)) ++different;
            EXPECT_LE(std::max({error.x, error.y, error.z}), 4. / 255) << scenario << " texel " << i;
        }
        EXPECT_LE(different, by_vertex.texels.size() / 1000) << scenario;
    }
}

TEST(VoxelMultiply, AddsByNoAtomics) {
    const auto session = scenario_session("particle_storm");
    const auto run = multiplied_run(*session);
    EXPECT_EQ(counted(run, "atomics"), 0u);
    EXPECT_EQ(counted(run, "overflowed"), 0u);
    EXPECT_GT(counted(run, "columns"), 0u);
}

/// What is stored grows to the right in all of 8 bits, the factor downwards. llvmpipe's (ab + (ab >> 8) + 128) >> 8 for ab / 255
/// is a code below the nearest for 24 of the 65536 products of 8 bits.
TEST(VoxelMultiply, RoundsEveryBlendAsTheModelDoes) {
    constexpr std::uint32_t size = 256;
    constexpr std::pair<std::uint32_t, Format> stored[] = {{transparency::bits_8, Format::r8_unorm},
                                                           {transparency::bits_16, Format::r16_unorm}};
    for (const auto& [bits, format] : stored) {
        TestFrame frame;
        frame.shader("across.frag", R"(
            layout(location = 0) out float stored;
            void main() { stored = floor(gl_FragCoord.x) / 255.0; })");
        frame.shader("down.frag", R"(
            layout(location = 0) out float factor;
            void main() { factor = gl_FragCoord.y / 256.0; })");
        Image product = frame.graph.create("product", {.extent = {size, size}, .format = format});
        frame.graph.fullscreen("across").covers(product);
        frame.graph.fullscreen("down").multiplies(product);
        const HostImage result = frame.result(product);
        std::size_t wrong = 0;
        for (std::uint32_t y = 0; y < size; ++y)
            for (std::uint32_t x = 0; x < size; ++x) {
                const double expected = transparency::multiplied(x / 255., (y + .5) / 256, bits);
                const double error = std::abs(texel(result, x, y).x - expected);
                if (error > 1e-6) ++wrong;
                EXPECT_LT(error, 1.01 / (bits == transparency::bits_8 ? 255 : 65535));
            }
        EXPECT_LE(wrong, bits == transparency::bits_8 ? 24u : 128u) << row(format).name;
    }
}

/// Particles face the eye, so a triangle has one depth.
TEST(ExhaustiveVoxelMultiply, IsWhatTheModelSaysOfParticlesInEveryFormat) {
    const Technique& technique = *must(find_technique(voxel));
    for (const char* scenario : {"smoke_grenade", "particle_storm", "explosion"})
        for (const char* bits : {"bits=8", "bits=16", "bits=32"}) {
            Request request = on_scenario(scenario);
            request.choices = chosen({voxel}, {"splat=multiply", bits});
            const Accuracy accuracy = must(session_of_scenarios().judge(request, technique.stage, Against::model));
            expect_within_tolerance(accuracy, technique, request, scenario);
        }
}

TEST(ExhaustiveVoxelMultiply, IsWhatTheModelSaysInCombinations) {
    const Technique& technique = *must(find_technique(voxel));
    const std::vector<std::string> combinations[] = {
        {"slices=37", "bits=16", "sampling=point"},
        {"slices=99", "resolution=half", "curve=thickness", "near_thickness=0.3"},
        {"slices=256", "channels=mono", "resolution=eighth", "sampling=bicubic"},
    };
    for (std::vector<std::string> sets : combinations) {
        sets.push_back("splat=multiply");
        Request request = on_scenario("glass_and_smoke", 4);
        request.choices = chosen({voxel}, sets);
        const Accuracy accuracy = must(session_of_scenarios().judge(request, technique.stage, Against::model));
        expect_within_tolerance(accuracy, technique, request, "glass_and_smoke");
    }
}

}  // namespace
}  // namespace strata
