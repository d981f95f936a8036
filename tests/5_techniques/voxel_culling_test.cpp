// Fragments that nobody sees are not shaded, and the picture is the same to the last bit.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "capture_format/view.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "passes/transparency/functions/model.h"
#include "passes/transparency/voxel/slices/depth_curve.h"
#include "passes/transparency/voxel/thick_fragments/segment_model.h"
#include "passes/transparency/voxel/volume/column.h"
#include "passes/transparency/voxel/volume/volume.h"
#include "tests/5_techniques/voxel_name.h"
#include "tests/support/agreement.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using namespace transparency;

constexpr const char* cullings[] = {"culling=quads_16", "culling=quads_32", "culling=full_screen"};

Run run_of(Session& session, Request request, std::vector<std::string> sets, const char* culling) {
    request.choices = chosen({voxel}, std::move(sets));
    set(request, culling);
    request.outputs = {"color"};
    return must(session.run(request));
}

std::size_t differing_pixels(const HostImage& a, const HostImage& b) {
    constexpr std::size_t pixel = 16;  // of rgba32f
    std::size_t differing = 0;
    for (std::size_t at = 0; at < a.texels.size(); at += pixel)
        differing += !std::ranges::equal(std::span(a.texels).subspan(at, pixel), std::span(b.texels).subspan(at, pixel));
    return differing;
}

/// Fragments that culling keeps from being shaded.
std::uint64_t expect_equal(Session& session, const Request& request, const std::vector<std::string>& sets,
                           std::span<const char* const> ways) {
    const Run all = run_of(session, request, sets, "culling=off");
    std::uint64_t least = counted(all, "unseen");
    for (const char* way : ways) {
        const Run culled = run_of(session, request, sets, way);
        EXPECT_EQ(differing_pixels(culled.images.at("color"), all.images.at("color")), 0u)
            << way << " " << testing::PrintToString(sets);
        EXPECT_EQ(counted(culled, "drawn"), counted(all, "drawn")) << way;
        least = std::min(least, counted(all, "unseen") - counted(culled, "unseen"));
    }
    return least;
}

TEST(ExhaustiveVoxelCulling, ChangesNoPixelOfAnyScenario) {
    const std::string_view samplings[] = {"point", "linear", "bicubic"}, resolutions[] = {"full", "quarter"};
    const std::span<const std::string_view> scenarios = info(Stage::transparency).scenarios;
    ASSERT_GE(scenarios.size(), 12u);
    for (std::size_t i = 0; i < scenarios.size(); ++i) {
        // Each of the twelve combinations in its turn: all of them on every scenario take minutes.
        const std::size_t coarse = i / 2 % 2;
        const std::uint32_t samples = (i + coarse) % 2 == 0 ? 1 : 4;
        const std::string_view sampling = samplings[(2 * i + coarse) % 3];
        SCOPED_TRACE(scenarios[i]);
        expect_equal(session_of_scenarios(), on_scenario(scenarios[i], samples),
                     {fmt::format("sampling={}", sampling), fmt::format("splatting={}", sampling == "point" ? "point" : "linear"),
                      fmt::format("resolution={}", resolutions[coarse])},
                     cullings);
    }
}

/// The grenade's smoke so dense that little is seen through it, with edges where it meets what is opaque: soft ones need what is
/// behind.
std::unique_ptr<Session> dense_smoke(std::uint32_t samples) {
    Frame frame = scenario_frames("smoke_grenade", samples).front();
    frame.view.width = 160, frame.view.height = 90;
    for (Emitter& emitter : frame.emitters) {
        emitter.soft_depth_fade = 0;
        for (Particle& particle : emitter.particles) particle.alpha = 1 - std::pow(1 - particle.alpha, 24.f);
    }
    return session_of({frame});
}

TEST(VoxelCulling, LeavesUnshadedWhatDenseSmokeHides) {
    const auto session = dense_smoke(1);
    const auto shaded = [&](const char* culling) {
        const auto run = run_of(*session, {}, {}, culling);
        return double(counted(run, "drawn") + counted(run, "unseen"));
    };
    EXPECT_LT(shaded("culling=quads_16"), .8 * shaded("culling=off"));
    EXPECT_EQ(shaded("culling=full_screen"), shaded("culling=quads_16"));
    EXPECT_LT(shaded("culling=quads_16"), shaded("culling=quads_32"));
}

/// 64 places of the eye. Culling applies at some of them only.
std::vector<Request> camera_path() {
    std::vector<Request> places;
    for (int i = 0; i < 64; ++i) places.push_back({.variant = {.extent_divisor = 2, .eye = {.dolly = .02 * i, .pan = .004 * i}}});
    return places;
}

TEST(ExhaustiveVoxelCulling, ChangesNoPixelAlongACameraPath) {
    const auto session = dense_smoke(1);
    std::uint64_t unshaded = 0;
    for (const Request& request : camera_path()) {
        SCOPED_TRACE(request.variant.eye.dolly);
        unshaded += expect_equal(*session, request, {}, std::array{"culling=quads_16"});
    }
    EXPECT_GT(unshaded, 0u);
}

TEST(ExhaustiveVoxelSkipping, ChangesNoPixelAlongACameraPath) {
    const auto session = dense_smoke(1);
    for (const Request& request : camera_path()) {
        SCOPED_TRACE(request.variant.eye.dolly);
        const auto all = run_of(*session, request, {"skipping=off"}, "culling=quads_16");
        const auto used = run_of(*session, request, {"skipping=on"}, "culling=quads_16");
        EXPECT_EQ(differing_pixels(used.images.at("color"), all.images.at("color")), 0u);
        EXPECT_LT(counted(used, "cleared"), counted(all, "cleared"));
    }
}

Request prepared(const char* when, std::vector<std::string> sets = {}) {
    sets.emplace_back(when);
    return {.choices = chosen({voxel}, std::move(sets)), .outputs = {"color", "depth_layers"}};
}

TEST(ExhaustiveVoxelPreparedBeforeOpaque, ShowsTheSamePictureUpToWhatAFullColumnLetsThrough) {
    for (const std::uint32_t samples : {1u, 4u}) {
        const auto session = dense_smoke(samples);
        const ReferenceImage after = in_double(must(session->run(prepared("prepared=after_opaque"))).images.at("color"));
        const ReferenceImage before = in_double(must(session->run(prepared("prepared=before_opaque"))).images.at("color"));
        double brightest = 0, largest = 0;
        for (std::size_t i = 0; i < after.texels.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                brightest = std::max(brightest, after.texels[i][c]);
                largest = std::max(largest, std::abs(after.texels[i][c] - before.texels[i][c]));
            }
        // Samples at an edge, which columns do not see, may show the background instead of what was hidden.
        EXPECT_LE(largest / brightest, samples == 1 ? 1. / 255 : .02) << samples;
    }
}

TEST(ExhaustiveVoxelPreparedBeforeOpaque, IsWhatTheModelSays) {
    const Technique& technique = *must(find_technique(voxel));
    const auto session = dense_smoke(4);
    for (const char* resolution : {"resolution=full", "resolution=quarter"}) {
        const Request request = prepared("prepared=before_opaque", {resolution});
        const Accuracy accuracy = must(session->judge(request, technique.stage, Against::model));
        expect_within_tolerance(accuracy, technique, request);
    }
}

TEST(VoxelPreparedBeforeOpaque, LeavesOutOpaqueSurfacesThatNobodySees) {
    const auto session = dense_smoke(1);
    const std::array requests{prepared("prepared=after_opaque"), prepared("prepared=before_opaque")};
    const std::array runs{must(session->run(requests[0])), must(session->run(requests[1]))};
    const ReferenceImage after = in_double(runs[0].images.at("depth_layers")),
                         before = in_double(runs[1].images.at("depth_layers"));
    std::size_t hidden = 0;
    for (std::size_t i = 0; i < after.texels.size(); ++i) {
        if (before.texels[i].x == after.texels[i].x) continue;
        EXPECT_EQ(before.texels[i].x, 0);
        ++hidden;
    }
    EXPECT_GT(hidden, 0u);
}

TEST(VoxelPreparedBeforeOpaque, WaitsForOpaqueDepthWhereParticlesAreSoft) {
    Request request = on_scenario("smoke_grenade");
    const auto after = run_of(session_of_scenarios(), request, {}, "culling=quads_16");
    const auto before = run_of(session_of_scenarios(), request, {"prepared=before_opaque"}, "culling=quads_16");
    EXPECT_EQ(before.images.at("color").texels, after.images.at("color").texels);
}

/// Pixels of which culling from so many slices behind the full one would take something away that is seen.
std::size_t pixels_losing_something(const FragmentLists& lists, const Frame& frame, const VoxelParams& params, double slices) {
    const View& view = frame.view;
    const ColumnFormat format = column_format(params);
    const DepthCurve curve = depth_curve(params, voxel_range(params, frame));
    std::size_t losing = 0;
    for (std::uint32_t pixel = 0; pixel < view.width * view.height; ++pixel) {
        const std::span<const Fragment> fragments = lists.at(pixel % view.width, pixel / view.width);
        transparency::Column column(format);
        for (const Fragment& f : fragments)
            column.add(split_code(format, slice_place(curve.slice_of(f.depth), format.slices, params.splatting),
                                  format.codes(channel_depth(f, 0, 1)), .5));
        const std::vector<std::uint32_t> codes = column.integral();
        const std::vector<double> integral(codes.begin(), codes.end());
        const auto full = std::ranges::find(codes, format.full_code) - codes.begin();
        losing += std::ranges::any_of(fragments, [&](const Fragment& f) {
            const double s = curve.slice_of(f.depth), at = s + sampling_bias(params.sampling);
            return s >= double(full) + slices && format.transmittance(sampled_integral(integral, at, params.sampling)) > 0;
        });
    }
    return losing;
}

TEST(VoxelCulling, FromTheFullSliceItselfWouldTakeAwayWhatIsSeen) {
    const Request request = on_scenario("smoke_grenade");
    const FragmentLists& lists = *must(session_of_scenarios().transparent_fragments(request));
    Frame frame = must(session_of_scenarios().frame(request.variant.frame));
    frame.view.width /= request.variant.extent_divisor, frame.view.height /= request.variant.extent_divisor;
    const Settings settings(must(find_technique(voxel))->params);
    for (const std::uint32_t sampling : {sampling_point, sampling_linear, sampling_bicubic}) {
        VoxelParams params = settings.as<VoxelParams>();
        params.volume = volume_dense;
        params.sampling = sampling;
        params.splatting = sampling == sampling_point ? splatting_point : splatting_linear;
        EXPECT_GT(pixels_losing_something(lists, frame, params, 0), 0u) << sampling;
        EXPECT_EQ(pixels_losing_something(lists, frame, params, slices_to_zero(params)), 0u) << sampling;
    }
}

}  // namespace
}  // namespace strata
